#pragma once

#include "server/settings_options.h"
#include "solver/view_factors.h"

#include <optional>
#include <string>

namespace patchlight::server {

/// `patchlight form-factors`.
class FormFactorsCommand {
  public:
    /// Has to outlive the program, which writes into it. Returns the command.
    CLI::App* add_to(CLI::App& program);

    /// Returns the exit code. Throws WrongInput, and what ViewFactorSolver throws.
    int run() const;

  private:
    ViewFactorReport find(const ViewFactorSolver& solver) const;
    void tell(const ViewFactorReport& report, double seconds) const;

    std::string scene_;
    std::string by_ = "object";
    std::string output_ = "-";
    std::optional<std::string> stats_;
    bool is_quiet_ = false;
    SettingsOptions settings_;
};

}  // namespace patchlight::server
