#pragma once

#include "server/chart/chart.h"

namespace patchlight::server {

/// A point with no picture; `setting` is its accuracy, if the series is auto, else its rays.
ChartPoint chart_point(SeriesIndex series, double setting, double seconds, double error);

/// Three accuracies, Gauss–Seidel on analytic factors twice and on ray-cast ones once, one method
/// skipped, a reference of accuracy 0.001 that estimates its error at 0.0008; marked.
Chart small_chart();

}  // namespace patchlight::server
