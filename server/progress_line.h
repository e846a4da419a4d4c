#pragma once

#include "solver/settings.h"

#include <chrono>

namespace patchlight::server {

/// One line on standard error that is written over and over: what is being done, how far it is and
/// how long it will take. Nothing at all if standard error is no terminal.
class ProgressLine {
  public:
    explicit ProgressLine(bool is_wanted);
    ~ProgressLine();  // wipes it
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    void show(const Progress& progress);

  private:
    using Clock = std::chrono::steady_clock;

    bool is_shown_;
    bool is_dirty_ = false;
    Stage stage_ = Stage::mesh;
    Clock::time_point stage_begin_ = Clock::now();
    Clock::time_point heard_ = Clock::now();  // of the work, last
    Clock::time_point shown_ = Clock::now();
};

}  // namespace patchlight::server
