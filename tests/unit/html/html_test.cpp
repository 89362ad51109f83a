// SPDX-License-Identifier: Apache-2.0
// HTML as text, and images in it.
#include "html/html.hpp"

#include <gmock/gmock.h>

#include <gnomon/error.hpp>

#include "html/image.hpp"
#include "io/png.hpp"

namespace gnomon::html {
namespace {

TEST(Html, TextAndAttributesAreEscaped) {
    EXPECT_EQ(escaped("a < b & \"c\" > d"), "a &lt; b &amp; &quot;c&quot; &gt; d");
    EXPECT_EQ(element("p", {{"title", "<\">"}}, "<b>bold</b>"), "<p title=\"&lt;&quot;&gt;\"><b>bold</b></p>");
    EXPECT_EQ(empty_element("img", {{"src", "a"}}), "<img src=\"a\">");
}

TEST(Html, TablesHaveHeadings) {
    Table table({"run", "ms"});
    table.add({"tsm", "1"});
    EXPECT_THAT(table.html(), testing::HasSubstr("<th scope=\"col\">ms</th>"));
    EXPECT_THAT(table.html(), testing::HasSubstr("<tr><th scope=\"row\">tsm</th><td>1</td></tr>"));
    Table words({"run", "why"}, {false, true});
    words.add({"tsm", "so"}, {"", "2"});
    EXPECT_THAT(words.html(), testing::HasSubstr("<th scope=\"col\" class=\"text\">why</th>"));
    EXPECT_THAT(words.html(), testing::HasSubstr("<td class=\"text\" data-order=\"2\">so</td>"));
}

TEST(Html, TemplatesAreFilled) {
    EXPECT_EQ(filled("{{a}} and {{b}}, {{a}}", {{"a", "{{b}}"}, {"b", "2"}}), "{{b}} and 2, {{b}}");
    EXPECT_EQ(filled("{ } }} {{", {}), "{ } }} {{");
    EXPECT_THROW(filled("{{c}}", {{"a", ""}}), Error);
}

// RFC 4648, section 10, by way of the padding that PNG files of these sizes need.
TEST(Pictures, AreBase64) {
    for (const uint32_t width : {1u, 2u, 3u, 4u, 9u}) {
        const std::vector<uint8_t> rgb(width * 3, 77);
        const size_t bytes = io::encode_png(width, 1, rgb).size();
        const std::string address = png_address(width, 1, rgb);
        ASSERT_THAT(address, testing::StartsWith("data:image/png;base64,iVBORw0KGgo"));
        const std::string text = address.substr(address.find(',') + 1);
        EXPECT_EQ(text.size(), (bytes + 2) / 3 * 4);
        EXPECT_EQ(text.find('=') == std::string::npos ? 0u : text.size() - text.find('='), (3 - bytes % 3) % 3);
        // A PNG file ends with the chunk IEND and its checksum.
        const char* ends[] = {"AAAABJRU5ErkJggg==", "AAAAAElFTkSuQmCC", "AAAAASUVORK5CYII="};
        const bool known = std::any_of(std::begin(ends), std::end(ends), [&](const char* end) { return text.ends_with(end); });
        EXPECT_TRUE(known) << text;
    }
}

}  // namespace
}  // namespace gnomon::html
