#pragma once

#include "server/run_job.h"
#include "server/settings_options.h"

#include <optional>
#include <string>
#include <vector>

namespace patchlight::server {

/// `patchlight solve`.
class SolveCommand {
  public:
    /// Has to outlive the program, which writes into it. Returns the command.
    CLI::App* add_to(CLI::App& program);

    /// Returns the exit code. Throws WrongInput, and what run_job throws.
    int run() const;

  private:
    std::vector<ImageFormat> checked_formats() const;
    Job read_job() const;
    NamedCamera& chosen_camera(Job& job) const;
    void write(const Job& job, const JobResult& result) const;

    std::string scene_;
    std::vector<std::string> images_;
    std::optional<std::string> camera_;
    std::optional<std::string> size_;
    std::optional<double> exposure_;
    std::optional<std::string> stats_;
    bool is_quiet_ = false;
    SettingsOptions settings_;
};

}  // namespace patchlight::server
