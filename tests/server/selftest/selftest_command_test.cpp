#include "tests/server/run_program.h"

#include "server/selftest/known_families.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace patchlight::server::selftest_command_test {
namespace {

class SelftestCommand : public testing::TestWithParam<std::string> {};

TEST_P(SelftestCommand, PassesOnThisBuild) {
    const Outcome outcome = run_program("selftest --only " + GetParam() + " --output table.csv");
    EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
    EXPECT_NE(outcome.out.find("\npassed: "), std::string::npos) << outcome.out;
    std::istringstream csv(read_test_file("table.csv"));
    std::string line;
    std::getline(csv, line);
    EXPECT_EQ(line, "case,quantity,method,result,exact,published,error,bound,seconds,within");
    std::size_t rows = 0;
    for (; std::getline(csv, line); ++rows) EXPECT_TRUE(line.ends_with(",true")) << line;
    EXPECT_GE(rows, 8u);
    EXPECT_EQ(static_cast<std::size_t>(std::count(outcome.out.begin(), outcome.out.end(), '\n')),
              rows + 3)
        << "machine, heads and verdict beside the rows\n"
        << outcome.out;
}

std::vector<std::string> family_names() {
    std::vector<std::string> names;
    for (const KnownFamily& family : known_families()) names.emplace_back(family.name);
    return names;
}

INSTANTIATE_TEST_SUITE_P(EveryFamily, SelftestCommand, testing::ValuesIn(family_names()),
                         [](const auto& each) {
                             std::string name = each.param;
                             std::erase(name, '-');
                             return name;
                         });

TEST(Selftest, WrongArgumentsAreRefusedBeforeAnyWork) {
    const auto expect_refused = [](const std::string& arguments, const std::string& words) {
        const Outcome outcome = run_program("selftest " + arguments);
        EXPECT_EQ(outcome.code, 2) << arguments;
        EXPECT_EQ(outcome.out, "") << arguments;
        EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
    };
    expect_refused("--only cube", "--only: there are no cases 'cube'; did you mean 'cubes'?");
    expect_refused("--output table.txt", "must end in .csv or .json");
    expect_refused("--output absent/table.csv", "no directory");
    expect_refused("scene.json", "scene.json");
}

TEST(Selftest, InterruptedItGivesNoVerdictAndNoFile) {
    const Outcome outcome = run_program("selftest --output cut.csv",
                                        "timeout --foreground --preserve-status -s INT 0.3");
    EXPECT_EQ(outcome.code, 130) << outcome.err;
    EXPECT_EQ(outcome.out.find("passed"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.err.find("no verdict"), std::string::npos) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(test_file("cut.csv")));
}

}  // namespace
}  // namespace patchlight::server::selftest_command_test
