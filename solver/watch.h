#pragma once

#include "solver/settings.h"
#include "solver/transport/stop_rule.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <optional>

namespace patchlight {

/// Passes progress on, and tells when the work must stop and why.
class Watch {
  public:
    Watch(const Observer& observe, std::optional<double> time_limit)
        : observe_(observe), time_limit_(time_limit) {}

    /// Seconds since the last lap.
    double lap() {
        const auto now = Clock::now();
        const double seconds = std::chrono::duration<double>(now - lap_).count();
        lap_ = now;
        return seconds;
    }
    /// Since the last lap, which goes on.
    double seconds_so_far() const {
        return std::chrono::duration<double>(Clock::now() - lap_).count();
    }
    /// `tolerance`: go on. `share`: of the time limit, what this work must leave the rest to.
    StopReason step(const Progress& progress, double share = 1.0) {
        if (observe_ && observe_(progress) == Verdict::stop) return StopReason::cancelled;
        if (seconds_left(share) < 0.0) return StopReason::time_limit;
        return StopReason::tolerance;
    }
    /// Until a share of the time limit has passed, or as much of the reserve as is kept with that
    /// share is left; without a limit for ever.
    double seconds_left(double share = 1.0) const {
        if (!time_limit_) return std::numeric_limits<double>::infinity();
        const double kept = share < 1.0 ? (1.0 - share) / reserved_from_ * reserve_ : 0.0;
        return std::min(share * *time_limit_, *time_limit_ - kept) -
               std::chrono::duration<double>(Clock::now() - start_).count();
    }
    /// Of a time limit: what the work is known to need after `share` of it, and in proportion
    /// after larger shares [s].
    void reserve(double seconds, double share) {
        reserve_ = seconds;
        reserved_from_ = 1.0 - share;
    }
    /// Of the whole time limit; may be asked from several threads.
    bool in_time() const { return seconds_left() > 0.0; }
    /// Whether work on form factors that has not come to any of them yet may go on.
    bool may_prepare() { return step({Stage::form_factors}) == StopReason::tolerance; }

  private:
    using Clock = std::chrono::steady_clock;
    const Observer& observe_;
    std::optional<double> time_limit_;
    Clock::time_point start_ = Clock::now(), lap_ = start_;
    double reserve_ = 0.0, reserved_from_ = 1.0;
};

/// What a solution says of why its work ended. Throws std::logic_error for no reason at all.
Status status_of(StopReason reason);

}  // namespace patchlight
