#pragma once

#include <string>

namespace patchlight::server {

struct Outcome {
    int code = -1;
    std::string out;
    std::string err;
};

/// Runs the program `patchlight` through a shell, in a directory of this test alone: arguments and
/// redirections as one would type them. `before` goes in front of the program.
Outcome run_program(const std::string& arguments, const std::string& before = "");

/// The path of a file in that directory.
std::string test_file(const std::string& name);

/// Writes such a file and returns its name as the program sees it.
std::string write_test_file(const std::string& name, const std::string& bytes);

std::string read_test_file(const std::string& name);

}  // namespace patchlight::server
