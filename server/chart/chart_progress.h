#pragma once

#include <chrono>
#include <string>

namespace patchlight::server {

/// One line on standard error that says which solve a chart is at and how much of its time is
/// spent. Nothing at all if standard error is no terminal.
class ChartProgressLine {
  public:
    explicit ChartProgressLine(bool is_wanted);
    ~ChartProgressLine();  // wipes it
    ChartProgressLine(const ChartProgressLine&) = delete;
    ChartProgressLine& operator=(const ChartProgressLine&) = delete;

    /// `share` of the time [1].
    void show(const std::string& doing, double share);

  private:
    using Clock = std::chrono::steady_clock;

    bool is_shown_;
    bool is_dirty_ = false;
    Clock::time_point shown_;
};

}  // namespace patchlight::server
