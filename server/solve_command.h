#pragma once

#include "server/picture_options.h"
#include "server/settings_options.h"
#include "server/solve_outputs.h"
#include "server/trace/trace_options.h"

#include <functional>
#include <string>

namespace patchlight::server {

/// `patchlight solve`.
class SolveCommand {
  public:
    /// Has to outlive the program, which writes into it. Returns the command.
    CLI::App* add_to(CLI::App& program);

    /// Returns the exit code. Throws WrongInput, and what run_job throws.
    int run() const;

  private:
    Job read_job() const;
    /// `watch` is told each step of progress.
    JobResult solve(const Job& job, const std::vector<PictureRequest>& requests,
                    double load_seconds, const std::function<void(const Progress&)>& watch) const;

    std::string scene_;
    SolveOutputs outputs_;
    PictureOptions pictures_;
    TraceOptions trace_;
    bool is_quiet_ = false;
    SettingsOptions settings_;
};

}  // namespace patchlight::server
