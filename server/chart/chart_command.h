#pragma once

#include <string>

namespace CLI {
class App;
}

namespace patchlight::server {

/// `patchlight chart`.
class ChartCommand {
  public:
    /// Has to outlive the program, which writes into it. Returns the command.
    CLI::App* add_to(CLI::App& program);

    /// Returns the exit code. Throws WrongInput, and what solve_scene throws.
    int run() const;

  private:
    std::string scene_;
    std::string directory_;
    double time_limit_ = 120.0;  // [s]
    bool is_quiet_ = false;
};

}  // namespace patchlight::server
