#include "server/output_files.h"

#include "server/wrong_input.h"
#include "tests/server/run_program.h"

#include <gtest/gtest.h>

namespace patchlight::server::output_files_test {
namespace {

TEST(OutputFiles, AFileInADirectoryThatIsThereCanBeMade) {
    EXPECT_NO_THROW(require_writable("--stats", "new-file.json"));
    EXPECT_NO_THROW(require_writable("--stats", testing::TempDir() + "new-file.json"));
    EXPECT_NO_THROW(require_writable("--stats", "/dev/null"));
}

TEST(OutputFiles, WhatCannotBeMadeIsToldEarly) {
    EXPECT_THROW(require_writable("--stats", ""), WrongInput);
    EXPECT_THROW(require_writable("--stats", testing::TempDir()), WrongInput);
    EXPECT_THROW(require_writable("--stats", "no-such-directory/a.json"), WrongInput);
    EXPECT_THROW(require_writable("--stats", "/dev/null/a.json"), WrongInput);
}

TEST(OutputFiles, TwoOutputsAreTwoFiles) {
    EXPECT_NO_THROW(require_different({"a.png", "b.png", "/dev/null"}));
    EXPECT_THROW(require_different({"a.png", "b.png", "./a.png"}), WrongInput);
}

TEST(OutputFiles, WhatIsReadIsNotOverwritten) {
    const std::string room = write_test_file("room.json", R"({"version": 1})");
    const std::string mesh = write_test_file("square.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const std::string scene = write_test_file(
        "with_file.json", R"({"version": 1, "objects": [{"name": "o", "file": "square.obj"}]})");
    for (const char* const arguments :
         {"solve room.json --stats ./room.json", "form-factors room.json --stats room.json",
          "solve square.obj --stats square.obj", "solve with_file.json --stats square.obj"}) {
        const Outcome outcome = run_program(arguments);
        EXPECT_EQ(outcome.code, 2) << arguments;
        EXPECT_NE(outcome.err.find("is read, and would be lost"), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(read_test_file("room.json"), R"({"version": 1})");
    EXPECT_EQ(read_test_file("square.obj").size(), 32u);
}

}  // namespace
}  // namespace patchlight::server::output_files_test
