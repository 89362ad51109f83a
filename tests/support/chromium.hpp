// SPDX-License-Identifier: Apache-2.0
// A page in a browser, where Chromium is installed.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

namespace gnomon::test {

inline bool has_chromium() { return std::system("command -v chromium > /dev/null") == 0; }

/// What `reader`, JavaScript that runs when the page has loaded, has put into its object `seen`; empty after a failure. page:
/// HTML, shown in a frame of this width, since windows are not as narrow as telephones. Files go to `folder`.
inline nlohmann::json seen_in_chromium(const std::filesystem::path& folder, std::string page, const std::string& reader,
                                       int width = 1280, bool dark = false) {
    const auto content_of = [](const std::filesystem::path& path) {
        std::ifstream file(path, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    page.insert(page.rfind("</body>"), "<script>addEventListener('load', () => { const seen = {};\n" + reader +
                                           "\nparent.document.querySelector('#seen').textContent = 'SEEN' + "
                                           "JSON.stringify(seen) + 'SEEN'; });</script>");
    std::string attribute;
    for (const char c : page) attribute += c == '&' ? "&amp;" : c == '"' ? "&quot;" : std::string(1, c);
    std::ofstream(folder / "frame.html", std::ios::binary)
        << "<!doctype html><meta charset=\"utf-8\"><meta name=\"color-scheme\" content=\"light dark\">"
        << "<style>iframe { border: 0; height: 900px; width: " << width
        << "px }</style><pre id=\"seen\"></pre><iframe srcdoc=\"" << attribute << "\"></iframe>";
    const std::string command =
        "timeout 120 chromium --headless=new --no-sandbox --disable-gpu --hide-scrollbars "
        "--window-size=1700,1000 --blink-settings=preferredColorScheme=" +
        std::string(dark ? "0" : "1") + " --user-data-dir='" + (folder / "profile").string() + "' --dump-dom 'file://" +
        (folder / "frame.html").string() + "' > '" + (folder / "dom").string() + "' 2> '" + (folder / "log").string() + "'";
    const int status = std::system(command.c_str());
    const std::string dom = content_of(folder / "dom");
    const size_t begin = dom.find("SEEN{"), end = dom.rfind("}SEEN");
    EXPECT_EQ(status, 0) << content_of(folder / "log");
    EXPECT_NE(begin, std::string::npos) << content_of(folder / "log");
    if (status != 0 || begin == std::string::npos) return nlohmann::json::object();
    std::string text = dom.substr(begin + 4, end + 1 - begin - 4);
    for (const auto& [escaped, character] : {std::pair("&lt;", "<"), {"&gt;", ">"}, {"&amp;", "&"}})
        for (size_t at = text.find(escaped); at != std::string::npos; at = text.find(escaped, at + 1))
            text.replace(at, std::string(escaped).size(), character);
    return nlohmann::json::parse(text);
}

}  // namespace gnomon::test
