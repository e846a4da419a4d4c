#include "tests/server/run_program.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace patchlight::server {
namespace {

namespace fs = std::filesystem;

const fs::path& directory() {
    static const fs::path made = [] {
        const fs::path path =
            fs::path(testing::TempDir()) / ("patchlight-test-" + std::to_string(::getpid()));
        fs::create_directories(path);
        return path;
    }();
    return made;
}

/// Removes the directory when the tests are over.
class Cleaning : public testing::Environment {
  public:
    void TearDown() override {
        std::error_code left_behind;
        fs::remove_all(directory(), left_behind);
    }
};
const testing::Environment* const cleaning = testing::AddGlobalTestEnvironment(new Cleaning);

}  // namespace

Outcome run_program(const std::string& arguments, const std::string& before) {
    const std::string command = "cd '" + directory().string() + "' && (" + before + " '" +
                                PATCHLIGHT_PROGRAM + "' " + arguments + ") >out.txt 2>err.txt";
    const int status = std::system(command.c_str());
    Outcome outcome;
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    outcome.out = read_test_file("out.txt");
    outcome.err = read_test_file("err.txt");
    return outcome;
}

std::string test_file(const std::string& name) { return (directory() / name).string(); }

std::string write_test_file(const std::string& name, const std::string& bytes) {
    std::ofstream(directory() / name, std::ios::binary) << bytes;
    return name;
}

std::string read_test_file(const std::string& name) {
    std::ifstream file(directory() / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace patchlight::server
