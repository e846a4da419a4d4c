#include "server/progress_line.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace patchlight::server {
namespace {

constexpr const char* wipe = "\r\x1b[K";

std::string stage_name(Stage stage) {
    switch (stage) {
        case Stage::mesh:
            return "patches";
        case Stage::form_factors:
            return "form factors";
        case Stage::solve:
            return "solving";
        case Stage::display:
            return "display";
    }
    throw std::logic_error("a stage without a name");
}

std::string duration(double seconds) {
    if (seconds < 60.0) return std::to_string(std::lround(seconds)) + " s";
    const long minutes = std::lround(seconds / 60.0);
    if (minutes < 60) return std::to_string(minutes) + " min";
    return std::to_string(minutes / 60) + " h " + std::to_string(minutes % 60) + " min";
}

}  // namespace

ProgressLine::ProgressLine(bool is_wanted) : is_shown_(is_wanted && isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
    if (is_dirty_) std::fputs(wipe, stderr);
}

void ProgressLine::show(const Progress& progress) {
    if (!is_shown_) return;
    const Clock::time_point now = Clock::now();
    if (progress.stage != stage_) {
        stage_ = progress.stage;
        stage_begin_ = heard_;  // the first word of a stage comes when some of it is done
    }
    heard_ = now;
    constexpr std::chrono::milliseconds pause(100);  // short to the eye, long to the terminal
    if (now - shown_ < pause) return;
    shown_ = now;
    std::string line = stage_name(progress.stage);
    constexpr double telling = 0.02;  // of a stage: less of it says nothing of its length
    const double spent = std::chrono::duration<double>(now - stage_begin_).count();
    if (progress.fraction > 0.0)
        line.append(" ")
            .append(std::to_string(std::lround(100.0 * progress.fraction)))
            .append(" %");
    if (progress.iteration > 0) line.append(", step ").append(std::to_string(progress.iteration));
    if (progress.fraction > telling)
        line += ", " + duration(spent * (1.0 / progress.fraction - 1.0)) + " left";
    std::fputs((wipe + line).c_str(), stderr);
    is_dirty_ = true;
}

}  // namespace patchlight::server
