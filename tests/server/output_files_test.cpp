#include "server/output_files.h"

#include "server/wrong_input.h"

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

}  // namespace
}  // namespace patchlight::server::output_files_test
