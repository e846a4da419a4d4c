#include "server/chart/chart_progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace patchlight::server {

namespace {
constexpr const char* wipe = "\r\x1b[K";
}

ChartProgressLine::ChartProgressLine(bool is_wanted)
    : is_shown_(is_wanted && isatty(STDERR_FILENO) == 1) {}

ChartProgressLine::~ChartProgressLine() {
    if (is_dirty_) std::fputs(wipe, stderr);
}

void ChartProgressLine::show(const std::string& doing, double share) {
    if (!is_shown_) return;
    const Clock::time_point now = Clock::now();
    constexpr std::chrono::milliseconds pause(100);  // short to the eye, long to the terminal
    if (now - shown_ < pause) return;
    shown_ = now;
    const long percent = std::lround(100.0 * std::clamp(share, 0.0, 1.0));
    std::fputs((wipe + std::to_string(percent) + " % of the time, " + doing).c_str(), stderr);
    is_dirty_ = true;
}

}  // namespace patchlight::server
