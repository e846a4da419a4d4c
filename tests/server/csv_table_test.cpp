#include "server/csv_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

namespace patchlight::server::csv_table_test {
namespace {

std::string table_of(const std::function<void(CsvTable&)>& fill) {
    std::string written;
    CsvTable table("h", [&](std::string_view piece) { written += piece; });
    fill(table);
    table.finish();
    return written;
}

TEST(CsvTable, FieldsAreJoinedByCommasAndRowsEnded) {
    EXPECT_EQ(table_of([](CsvTable& table) {
                  table.text("a").number(1.5).number(std::size_t{7}).end_row();
                  table.numbers(Vec3(1, -2, 0.1)).end_row();
              }),
              "h\na,1.5,7\n1,-2,0.1\n");
}

TEST(CsvTable, TextsAreQuotedWhereTheyNeedIt) {
    const auto quoted = [](std::string_view text) {
        const std::string table = table_of([&](CsvTable& t) { t.text(text).end_row(); });
        return table.substr(2, table.size() - 3);
    };
    EXPECT_EQ(quoted("plain name/é#2"), "plain name/é#2");
    EXPECT_EQ(quoted(""), "");
    EXPECT_EQ(quoted("plane[0,1]"), "\"plane[0,1]\"");
    EXPECT_EQ(quoted("the \"big\" one"), "\"the \"\"big\"\" one\"");
    EXPECT_EQ(quoted("two\nlines"), "\"two\nlines\"");
    EXPECT_EQ(quoted("two\rlines"), "\"two\rlines\"");
}

TEST(CsvTable, NumbersReadBackAsTheSame) {
    for (const double number : {0.1, 1.0 / 3.0, 1e-300, 1e22, std::numbers::pi, -2.5e-7,
                                std::numeric_limits<double>::max()}) {
        const std::string table = table_of([&](CsvTable& t) { t.number(number).end_row(); });
        EXPECT_EQ(std::strtod(table.c_str() + 2, nullptr), number) << table;
    }
    EXPECT_EQ(table_of([](CsvTable& t) { t.number(-0.0).end_row(); }), "h\n0\n");
}

TEST(CsvTable, ALongTableIsHandedOnInPieces) {
    std::size_t pieces = 0, largest = 0, total = 0;
    CsvTable table("h", [&](std::string_view piece) {
        ++pieces;
        largest = std::max(largest, piece.size());
        total += piece.size();
    });
    for (int k = 0; k < 100'000; ++k) table.text("abcd").end_row();
    table.finish();
    EXPECT_EQ(total, 500'002u);
    EXPECT_GT(pieces, 4u);
    EXPECT_LT(largest, 100'000u);
}

}  // namespace
}  // namespace patchlight::server::csv_table_test
