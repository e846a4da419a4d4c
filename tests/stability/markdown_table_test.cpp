#include "tests/stability/markdown_table.h"

#include <gtest/gtest.h>

namespace patchlight::stability::markdown_table_test {
namespace {

const MarkdownTable table{
    {"mode", "what", "a", "seconds"},
    {{"A1", "near", "degrades 0.02", "3"}, {"A2", "far", "holds 1e-07", "4"}}};

MarkdownTable with_cell(std::size_t row, std::size_t column, const std::string& cell) {
    MarkdownTable changed = table;
    changed.rows[row][column] = cell;
    return changed;
}

TEST(MarkdownTable, IsReadBackFromTheDocumentItWasPutInto) {
    const std::string document =
        with_table("before\n<!-- begin x -->\nold\n<!-- end x -->\nafter\n", "x", table);
    const MarkdownTable read = table_in(document, "x");
    EXPECT_EQ(read.head, table.head);
    EXPECT_EQ(read.rows, table.rows);
    EXPECT_TRUE(document.starts_with("before\n") && document.ends_with("after\n"));
    EXPECT_THROW(with_table("nothing", "x", table), std::runtime_error);
}

TEST(MarkdownTable, AgreesWithItselfAndWithFiguresWithinAFactorOfTwo) {
    for (const MarkdownTable& other :
         {table, with_cell(0, 2, "degrades 0.039"), with_cell(0, 3, "1000"),
          with_cell(1, 2, "holds 0.001"), with_cell(0, 2, "holds 0.015")})
        EXPECT_TRUE(disagreements(table, other, 2).empty());
    MarkdownTable shorter = table;
    shorter.rows.pop_back();
    EXPECT_TRUE(disagreements(table, shorter, 2, Rows::may_differ).empty());
}

TEST(MarkdownTable, DisagreesWhereAVerdictAFigureOrARowDoes) {
    MarkdownTable shorter = table, longer = table;
    shorter.rows.pop_back();
    longer.rows.push_back({"A3", "new", "holds", "1"});
    for (const MarkdownTable& other :
         {with_cell(0, 2, "holds 0.0099"), with_cell(0, 2, "degrades 0.041"),
          with_cell(0, 2, "degrades 0.0099"), with_cell(0, 2, "degrades"),
          with_cell(1, 2, "refused"), with_cell(1, 1, "else"), shorter, longer, MarkdownTable{}})
        EXPECT_FALSE(disagreements(table, other, 2).empty());
}

}  // namespace
}  // namespace patchlight::stability::markdown_table_test
