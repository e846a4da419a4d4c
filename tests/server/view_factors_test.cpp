#include "server/view_factors_csv.h"
#include "server/view_factors_file.h"
#include "server/view_factors_json.h"
#include "server/view_factors_mtx.h"
#include "server/wrong_input.h"
#include "tests/server/run_program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace patchlight::server::view_factors_test {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

const ViewFactorGroups objects{{"floor", "a, \"b\"", "lamp[2]"}, {2.0, 0.5, 1.25}};
const ViewFactorGroups patches{{}, {2.0, 0.5, 1.25}};

/// Three rows: with a factor of 0, without any, and on the diagonal.
void some_rows(const TakeViewFactorRow& take) {
    const std::vector<std::uint32_t> to{0, 1, 2};
    take({0, to, std::vector{0.0, 0.25, 0.1}, std::vector{0.5, 0.00125, unknown}});
    take({1, {}, {}, {}});
    take({2, std::span(to).subspan(2), std::vector{1e-6}, std::vector{unknown}});
}

TEST(ViewFactorsCsv, HasALineForEachPair) {
    std::string written;
    write_view_factors_csv(objects, some_rows, [&](std::string_view s) { written += s; });
    EXPECT_EQ(written,
              "from,to,factor,error\n"
              "floor,\"a, \"\"b\"\"\",0.25,1.25e-03\n"
              "floor,lamp[2],0.1,\n"
              "lamp[2],lamp[2],1e-06,\n");
}

TEST(ViewFactorsCsv, WithoutNamesItCountsFromZero) {
    std::string written;
    write_view_factors_csv(patches, some_rows, [&](std::string_view s) { written += s; });
    EXPECT_EQ(written, "from,to,factor,error\n0,1,0.25,1.25e-03\n0,2,0.1,\n2,2,1e-06,\n");
}

TEST(ViewFactorsJson, IsAnObjectWithALineForEachRow) {
    std::string written;
    write_view_factors_json(objects, some_rows, [&](std::string_view s) { written += s; });
    EXPECT_EQ(nlohmann::json::parse(written), nlohmann::json::parse(R"({
        "names": ["floor", "a, \"b\"", "lamp[2]"], "areas": [2.0, 0.5, 1.25],
        "rows": [{"from": 0, "to": [1, 2], "factor": [0.25, 0.1], "error": [0.00125, null]},
                 {"from": 2, "to": [2], "factor": [1e-6]}]})"));
    EXPECT_NE(written.find("\n{\"from\":2,\"to\":[2],\"factor\":[1e-06]}\n"), std::string::npos)
        << written;
}

TEST(ViewFactorsJson, WithoutNamesAndRowsItIsStillJson) {
    std::string written;
    write_view_factors_json(
        patches, [](const TakeViewFactorRow&) {}, [&](std::string_view s) { written += s; });
    const auto read = nlohmann::json::parse(written);
    EXPECT_FALSE(read.contains("names"));
    EXPECT_TRUE(read["rows"].empty());
}

TEST(ViewFactorsMtx, CountsFromOneAndTellsItsSize) {
    ViewFactorGroups groups = objects;
    groups.names[1] = "two\nlines";
    const std::string path = test_file("f.mtx");
    write_view_factors(path, groups, some_rows);
    EXPECT_EQ(read_test_file("f.mtx"),
              "%%MatrixMarket matrix coordinate real general\n"
              "% view factors: row from, column to\n"
              "% 1 floor\n"
              "% 2 two lines\n"
              "% 3 lamp[2]\n"
              "3 3                    3\n"
              "1 2 0.25\n"
              "1 3 0.1\n"
              "3 3 1e-06\n");
}

TEST(ViewFactorsFile, FormatsAreToldByTheName) {
    write_view_factors(test_file("f.CSV"), patches, some_rows);
    EXPECT_TRUE(read_test_file("f.CSV").starts_with("from,to,"));
    write_view_factors(test_file("f.json"), patches, some_rows);
    EXPECT_TRUE(read_test_file("f.json").starts_with("{\"areas\""));
    for (const char* right : {"-", "a.csv", "a.json", "a.mtx", "/dev/null"})
        EXPECT_NO_THROW(check_view_factors_output("--output", right)) << right;
    ASSERT_EQ(run_program("--version; mkfifo pipe.mtx").code, 0);
    for (const std::string& wrong : {std::string("a.txt"), std::string("absent/a.csv"),
                                     std::string(""), test_file("pipe.mtx")})
        EXPECT_THROW(check_view_factors_output("--output", wrong), WrongInput) << wrong;
}

TEST(ViewFactorsFile, WhatFailsOnTheWayLeavesNoFile) {
    const auto failing = [](const TakeViewFactorRow& take) {
        some_rows(take);
        throw std::runtime_error("no more");
    };
    for (const char* name : {"half.csv", "half.json", "half.mtx"}) {
        EXPECT_THROW(write_view_factors(test_file(name), objects, failing), std::runtime_error);
        EXPECT_FALSE(std::filesystem::exists(test_file(name))) << name;
    }
}

TEST(ViewFactorsFile, ManyRowsOutgrowTheBuffer) {
    constexpr std::uint32_t count = 300;
    const ViewFactorGroups groups{{}, std::vector<double>(count, 1.0)};
    std::vector<std::uint32_t> to(count);
    for (std::uint32_t k = 0; k < count; ++k) to[k] = k;
    const std::vector<double> factor(count, 1.0 / count), error(count, 1e-4);
    const auto rows = [&](const TakeViewFactorRow& take) {
        for (std::uint32_t i = 0; i < count; ++i) take({i, to, factor, error});
    };
    write_view_factors(test_file("many.mtx"), groups, rows);
    std::istringstream lines(read_test_file("many.mtx"));
    std::string line;
    for (int k = 0; k < 3; ++k) std::getline(lines, line);  // comments
    std::size_t height = 0, width = 0, entries = 0, read = 0, row = 0, column = 0;
    double number = 0.0, sum = 0.0;
    lines >> height >> width >> entries;
    while (lines >> row >> column >> number) sum += number, ++read;
    EXPECT_EQ(height, count);
    EXPECT_EQ(width, count);
    EXPECT_EQ(entries, std::size_t{count} * count);
    EXPECT_EQ(read, entries);
    EXPECT_EQ(row, count);
    EXPECT_NEAR(sum, count, 1e-4 * count);
    write_view_factors(test_file("many.json"), groups, rows);
    const auto document = nlohmann::json::parse(read_test_file("many.json"));
    ASSERT_EQ(document["rows"].size(), count);
    EXPECT_EQ(document["rows"][count - 1]["to"].get<std::vector<std::uint32_t>>(), to);
}

}  // namespace
}  // namespace patchlight::server::view_factors_test
