#pragma once

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace patchlight::server {

/// `patchlight selftest`.
class SelftestCommand {
  public:
    /// Has to outlive the program, which writes into it. Returns the command.
    CLI::App* add_to(CLI::App& program);

    /// Returns the exit code: 1 if an answer is out of bound. Throws WrongInput, and
    /// std::system_error naming the file.
    int run() const;

  private:
    std::vector<std::string> only_;  // families
    std::optional<std::string> output_;
};

}  // namespace patchlight::server
