// SPDX-License-Identifier: Apache-2.0
// Tables as pages, programs and papers have them.
#include "report/data_table.hpp"

#include <gmock/gmock.h>

#include "report/tables.hpp"

namespace gnomon::report {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

TEST(Numbers, HaveThreeDigitsThatCount) {
    EXPECT_EQ(shown(0.0), "0");
    EXPECT_EQ(shown(0.012345), "0.0123");
    EXPECT_EQ(shown(4.567), "4.57");
    EXPECT_EQ(shown(45.67), "45.7");
    EXPECT_EQ(shown(456.7), "457");
    EXPECT_EQ(shown(12.0), "12");
    EXPECT_EQ(shown(1234567.0), "1,234,567");
    EXPECT_EQ(shown(-123.0), "-123");
    EXPECT_EQ(shown(-1234.0), "-1,234");
}

DataTable small_table() {
    return {"t",
            "Title",
            "Caption.",
            {{"layout", "", true}, {"query", "ms"}},
            {{"a, \"b\"_|<", shown_cell(1234.5)}, {"c", Cell()}}};
}

TEST(DataTables, AreEscapedAsEachFormWants) {
    const DataTable table = small_table();
    EXPECT_EQ(table.csv(), "layout,\"query, ms\"\r\n\"a, \"\"b\"\"_|<\",1234.5\r\nc,\r\n");
    EXPECT_THAT(table.html(),
                HasSubstr("<th scope=\"row\" class=\"text\">a, &quot;b&quot;_|&lt;</th><td data-order=\"1234.5\">1,234</td>"));
    EXPECT_THAT(table.html(), HasSubstr("<td>–</td>"));
    EXPECT_THAT(table.markdown(),
                HasSubstr("| layout | query, ms |\n| --- | ---: |\n| a, &quot;b&quot;\\_\\|&lt; | 1,234 |\n"));
    EXPECT_THAT(table.latex(), HasSubstr("\\begin{tabular}{lr}\n\\toprule\nlayout & query, ms \\\\\n\\midrule\n"
                                         "a, \"b\"\\_|\\textless{} & 1,234 \\\\\n"));
}

TEST(DataTables, OfManyRowsAreLong) {
    DataTable table = small_table();
    EXPECT_EQ(table.latex().find("longtable"), std::string::npos);
    while (table.rows.size() < 50) table.rows.push_back(table.rows.back());
    EXPECT_THAT(table.latex(), HasSubstr("\\begin{longtable}{lr}"));
}

TEST(DataTables, LoseColumnsWithoutValues) {
    DataTable table{"t", "", "", {{"a"}, {"b"}, {"c"}}, {{"1", "", "3"}, {"", "", "6"}}};
    table.drop_empty_columns();
    ASSERT_THAT(table.columns, SizeIs(2));
    EXPECT_EQ(table.columns[1].name, "c");
    EXPECT_EQ(table.rows[1][1].text, "6");
}

BenchFile compared(const std::vector<std::pair<double, Verdict>>& ratios) {
    BenchFile file;
    for (const auto& [ratio, verdict] : ratios) {
        Case c;
        c.layout = "x";
        file.comparisons.push_back({file.cases.size(), "array", "query", 9, ratio, {}, {}, verdict});
        file.cases.push_back(c);
    }
    return file;
}

// The geometric mean of 2 and 8 is 4.
TEST(SummaryTable, HasGeometricMeansAndVerdicts) {
    const DataTable table = summary_table({compared({{2.0, Verdict::slower}, {8.0, Verdict::undecided}})});
    ASSERT_THAT(table.rows, SizeIs(1));
    std::vector<std::string> row;
    for (const Cell& cell : table.rows[0]) row.push_back(cell.text);
    EXPECT_THAT(row, testing::ElementsAre("x", "4.000", "2.000", "8.000", "0", "1", "0", "1"));
}

}  // namespace
}  // namespace gnomon::report
