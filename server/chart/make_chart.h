#pragma once

#include "server/chart/chart.h"
#include "server/job.h"

#include <functional>
#include <string>

namespace patchlight::server {

/// What is being done: "auto, accuracy 0.01", and how much of the time limit is spent [1].
using ChartProgress = std::function<void(const std::string& doing, double share)>;

struct ChartWishes {
    double time_limit = 120.0;  // of all solves together [s]
    int most_pixels = 160;      // along an edge of pictures
};

/// Throws InputError if there is no surface, or no light: what the solver would find out later.
void require_chartable(const Scene& scene);

/// Runs every method, the cheapest first, as long as the next is likely to be done in time, and
/// measures the true errors. `is_stopped` is asked often; what was done until then is kept.
/// Throws InputError if the scene cannot be solved, or if it has no light to err about.
Chart make_chart(const Job& job, const ChartWishes& wishes, const ChartProgress& tell,
                 const std::function<bool()>& is_stopped);

}  // namespace patchlight::server
