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

namespace gnomon::test {

inline bool has_chromium() { return std::system("command -v chromium > /dev/null") == 0; }

/// What `reader`, JavaScript that runs when the page has loaded, has put into its object `seen`. page: HTML. Files go to
/// `folder`. Of no use after a failure.
inline nlohmann::json seen_in_chromium(const std::filesystem::path& folder, std::string page, const std::string& reader,
                                       int width = 1280, bool dark = false) {
    const auto content_of = [](const std::filesystem::path& path) {
        std::ifstream file(path, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    const std::string script =
        "<pre id=\"seen\" hidden></pre><script>addEventListener('load', () => { const seen = {};\n" + reader +
        "\ndocument.querySelector('#seen').textContent = 'SEEN' + JSON.stringify(seen) + 'SEEN'; });</script>";
    page.insert(page.rfind("</body>"), script);
    std::ofstream(folder / "page.html", std::ios::binary) << page;
    const std::string command =
        "timeout 120 chromium --headless=new --no-sandbox --disable-gpu --hide-scrollbars --window-size=" +
        std::to_string(width) + ",900 --blink-settings=preferredColorScheme=" + (dark ? "0" : "1") + " --user-data-dir='" +
        (folder / "profile").string() + "' --dump-dom 'file://" + (folder / "page.html").string() + "' > '" +
        (folder / "dom").string() + "' 2> '" + (folder / "log").string() + "'";
    const int status = std::system(command.c_str());
    const std::string dom = content_of(folder / "dom");
    const size_t begin = dom.find("SEEN{"), end = dom.rfind("}SEEN");
    EXPECT_EQ(status, 0) << content_of(folder / "log");
    EXPECT_NE(begin, std::string::npos) << content_of(folder / "log");
    if (status != 0 || begin == std::string::npos) return nlohmann::json::object();
    return nlohmann::json::parse(dom.substr(begin + 4, end + 1 - begin - 4));
}

}  // namespace gnomon::test
