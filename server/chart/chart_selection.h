#pragma once

#include "server/chart/chart.h"

#include <optional>
#include <vector>

namespace patchlight::server {

// Which of the points a report shows side by side. Points without an error do not count.

/// The time of `auto` at the middle one of its accuracies; of the middle point of all if there is
/// none [s].
std::optional<double> middle_time(const Chart& chart);

/// Of every series the point of least error that took no longer than that, a tenth more allowed;
/// null if all took longer. Series without a point are left out.
struct Selected {
    SeriesIndex series = 0;
    const ChartPoint* point = nullptr;
};
std::vector<Selected> best_within_time(const Chart& chart, double seconds);

/// The least round error that every series came down to; if one of them was always above 50 %, the
/// one that most came down to [1].
double common_error(const Chart& chart);

/// Of every series the quickest point with at most that error; null if it never came so far.
std::vector<Selected> quickest_within_error(const Chart& chart, double error);

/// How what is chosen by itself fares against what is set by hand.
struct AutomaticScore {
    int points = 0;
    int on_front = 0;
    int unmatched = 0;        // with less error than any hand-set method came to
    double least_gain = 0.0;  // seconds of the quickest hand-set method that errs no more, over
    double most_gain = 0.0;   // its own, where there is one [1]
};
AutomaticScore score_automatic(const Chart& chart);

}  // namespace patchlight::server
