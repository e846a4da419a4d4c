#pragma once

#include "server/settings_options.h"

#include <string>

namespace patchlight::server {

/// `patchlight check`: whether a scene is right and what solving it would cost.
class CheckCommand {
  public:
    /// Has to outlive the program, which writes into it. Returns the command.
    CLI::App* add_to(CLI::App& program);

    /// Returns the exit code. Throws WrongInput.
    int run() const;

  private:
    std::string scene_;
    SettingsOptions settings_;
};

}  // namespace patchlight::server
