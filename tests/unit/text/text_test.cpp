// SPDX-License-Identifier: Apache-2.0
// Text that comes from elsewhere: read, checked, shown.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include "text/csv_field.hpp"
#include "text/json_bounds.hpp"
#include "text/json_line.hpp"
#include "text/percent_decoded.hpp"
#include "text/printable.hpp"
#include "text/read_text.hpp"
#include "unit/io/test_folder.hpp"
#include "unit/io/throws.hpp"

namespace gnomon::test {

using ::testing::HasSubstr;

TEST(Printable, NamesStayAsTheyAre) {
    for (const char* name : {"", "a b.glb", "b\u00fcro \u4e2d\u6587 \U0001f600", "C:\\a\\n.gltf", "\u00a0\ufeff"})
        EXPECT_EQ(printable(name), name);
}

TEST(Printable, WhatATerminalWouldActOnIsWritten) {
    EXPECT_EQ(printable("two\nlines\r\tand"), "two\\nlines\\r\\tand");
    EXPECT_EQ(printable("\x1b[31mred\x1b]0;title\x07"), "\\x1b[31mred\\x1b]0;title\\x07");
    EXPECT_EQ(printable(std::string_view("a\0b\x7f", 4)), "a\\x00b\\x7f");
    EXPECT_EQ(printable("\u009b2J"), "\\xc2\\x9b2J");                        // An escape sequence in one character.
    EXPECT_EQ(printable("\u2028\u202e"), "\\xe2\\x80\\xa8\\xe2\\x80\\xae");  // Ends the line; turns what follows.
}

TEST(Printable, BytesThatAreNotUtf8AreWritten) {
    EXPECT_EQ(printable("a\x9b"
                        "b\xff"),
              "a\\x9bb\\xff");
    EXPECT_EQ(printable("\xe2\x80"), "\\xe2\\x80");           // Cut off.
    EXPECT_EQ(printable("\xc0\x9b"), "\\xc0\\x9b");           // ESC - 0x40 in two bytes instead of one.
    EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");  // A surrogate.
    EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");
}

std::string nested(size_t levels) { return std::string(levels, '[') + std::string(levels, ']'); }

TEST(CheckJson, DepthAndSizeAreBounded) {
    EXPECT_NO_THROW(check_json(nested(64), "", ""));
    EXPECT_GNOMON_ERROR(check_json(nested(65), "a.json", "repair it"), ErrorKind::input,
                        "more than 64 deep, a.json; repair it");
    EXPECT_GNOMON_ERROR(check_json(nested(80'000), "", ""), ErrorKind::input, "deep");
    std::string objects = "[{}";
    for (int i = 0; i < 500'000; ++i) objects += ",{}";
    EXPECT_GNOMON_ERROR(check_json(objects + "]", "", ""), ErrorKind::input, "more than 500000 objects");
    EXPECT_GNOMON_ERROR(check_json("{", "", ""), ErrorKind::input, "not valid JSON");
}

TEST(JsonLine, OfMembersAndElements) {
    const std::string text = R"(
{
  "name": "a\"}]", "deep": [[1, {"x": []}], "]"],
  "buffers": [ { "block": "A",
                 "clear": -1.5e3 },
               true,
    { "block":
        "B" }
  ],

  "last"
     : 0
})";
    EXPECT_EQ(json_line(text, ""), 2u);
    EXPECT_EQ(json_line(text, "/name"), 3u);
    EXPECT_EQ(json_line(text, "/deep/1"), 3u);
    EXPECT_EQ(json_line(text, "/buffers"), 4u);
    EXPECT_EQ(json_line(text, "/buffers/0/block"), 4u);
    EXPECT_EQ(json_line(text, "/buffers/0/clear"), 5u);
    EXPECT_EQ(json_line(text, "/buffers/1"), 6u);
    EXPECT_EQ(json_line(text, "/buffers/2"), 7u);
    EXPECT_EQ(json_line(text, "/last"), 11u);
    // What is not there: its parent.
    EXPECT_EQ(json_line(text, "/buffers/2/clear"), 7u);
    EXPECT_EQ(json_line(text, "/buffers/3/clear"), 4u);
    EXPECT_EQ(json_line(text, "/none"), 2u);
    EXPECT_EQ(json_line(text, "/last/none/0"), 11u);
    EXPECT_EQ(json_line("1", "/a"), 1u);
    EXPECT_EQ(json_line("[]", "/0"), 1u);
    EXPECT_EQ(json_line("{}", "/a"), 1u);
}

class ReadTextTest : public TestFolder {};

TEST_F(ReadTextTest, RegularFilesOnly) {
    std::string reason;
    put_content(folder / "a", "hello");
    put_content(folder / "empty", "");
    EXPECT_EQ(read_text(folder / "a", reason), "hello");
    EXPECT_EQ(read_text(folder / "empty", reason), "");
    EXPECT_EQ(read_text(folder / "none", reason), std::nullopt);
    EXPECT_THAT(reason, HasSubstr("no such file"));
    EXPECT_EQ(read_text(folder, reason), std::nullopt);
    EXPECT_THAT(reason, HasSubstr("not a regular file"));
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_EQ(read_text(folder / "pipe", reason), std::nullopt);  // Nobody writes to it: to open it would be to wait.
    std::filesystem::resize_file(folder / "a", (uint64_t{64} << 20) + 1);
    EXPECT_EQ(read_text(folder / "a", reason), std::nullopt);
    EXPECT_THAT(reason, HasSubstr("more than 64 MiB"));
}

TEST(PercentDecoded, TwoHexadecimalDigits) {
    EXPECT_EQ(percent_decoded("a%20b%2F%c3%BC+"), "a b/\u00fc+");
    EXPECT_EQ(percent_decoded(""), "");
    for (const char* text : {"%", "a%2", "%g0", "%0g", "%%20"}) EXPECT_EQ(percent_decoded(text), std::nullopt) << text;
}

TEST(CsvField, WithinQuotesWhereItNeedsThem) {
    EXPECT_EQ(csv_field("two words; and more"), "two words; and more");
    EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
    EXPECT_EQ(csv_field("a \"b\""), "\"a \"\"b\"\"\"");
    EXPECT_EQ(csv_field("a\nb"), "\"a\nb\"");
}

}  // namespace gnomon::test
