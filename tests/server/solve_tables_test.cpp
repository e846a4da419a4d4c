#include "tests/server/run_program.h"
#include "tests/server/small_box.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace patchlight::server::solve_tables_test {
namespace {

std::ptrdiff_t line_count(const std::string& text) {
    return std::count(text.begin(), text.end(), '\n');
}

TEST(SolveTables, BothAreWrittenAndNothingElse) {
    const Outcome outcome =
        run_program("solve " + small_box_file() + " --sensors s.csv --patches p.csv");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "");
    EXPECT_TRUE(read_test_file("s.csv").starts_with("name,x,y,z,"));
    EXPECT_EQ(line_count(read_test_file("s.csv")), 2);
    EXPECT_TRUE(read_test_file("p.csv").starts_with("index,object,material,side,"));
    EXPECT_GT(line_count(read_test_file("p.csv")), 50);
}

TEST(SolveTables, StandardOutputCarriesTheSame) {
    const Outcome outcome =
        run_program("solve " + small_box_file() + " --patches - --sensors s.csv");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    run_program("solve " + small_box_file() + " --patches p.csv");
    EXPECT_EQ(outcome.out, read_test_file("p.csv"));
}

TEST(SolveTables, WhatIsWrongIsToldBeforeTheSolve) {
    const std::string never = "solve no-scene.json ";  // is read later than outputs are checked
    for (const auto& [arguments, words] :
         {std::pair{"--patches a.txt", "--patches a.txt: the name must end in .csv"},
          {"--sensors a.json", "must end in .csv"},
          {"--sensors nowhere/a.csv", "there is no directory nowhere"},
          {"--patches a.csv --sensors a.csv", "two outputs"},
          {"--patches - --stats -", "two outputs would be written to standard output"}}) {
        const Outcome outcome = run_program(never + arguments);
        EXPECT_EQ(outcome.code, 2) << arguments;
        EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
    }
}

TEST(SolveTables, AnInterruptedSolveWritesWhatThereIs) {
    const Outcome outcome =
        run_program("solve " + small_box_file() +
                        " --form-factors ray-cast --rays 1000000 --patch-size 0.1"
                        " --patches p.csv --sensors s.csv",
                    "timeout --foreground --preserve-status -s INT 1");
    EXPECT_EQ(outcome.code, 130) << outcome.err;
    EXPECT_TRUE(read_test_file("p.csv").ends_with("\n"));
    EXPECT_GT(line_count(read_test_file("p.csv")), 1000);
    EXPECT_GE(line_count(read_test_file("s.csv")), 1);
}

}  // namespace
}  // namespace patchlight::server::solve_tables_test
