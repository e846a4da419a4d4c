#pragma once

#include <string>

namespace CLI {
class App;
}

namespace patchlight::server {

/// `patchlight health`: whether a server is alive, for the health check of a container.
class HealthCommand {
  public:
    /// Has to outlive the program, which writes into it. Returns the command.
    CLI::App* add_to(CLI::App& program);

    /// Returns the exit code: 0 alive, 1 not.
    int run() const;

  private:
    std::string host_ = "127.0.0.1";
    int port_ = 8080;
};

}  // namespace patchlight::server
