#pragma once

#include "server/http/service_settings.h"

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace patchlight::server {

/// `patchlight serve`: the HTTP service.
class ServeCommand {
  public:
    /// Has to outlive the program, which writes into it. Returns the command.
    CLI::App* add_to(CLI::App& program);

    /// Serves until SIGINT or SIGTERM. Returns the exit code. Throws WrongInput, and
    /// std::runtime_error if it cannot listen.
    int run();

  private:
    void add_limits(CLI::App& command);
    void settle_token(bool is_loopback);

    ServiceSettings settings_;
    int port_ = 8080;
    std::optional<std::string> token_file_;
    double grace_ = 30.0;  // [s]
    bool is_quiet_ = false;
};

}  // namespace patchlight::server
