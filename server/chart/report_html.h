#pragma once

#include "server/chart/chart.h"
#include "server/chart/chart_origin.h"

#include <string>

namespace patchlight::server {

/// One page that holds all it shows and asks for nothing: the chart, pictures in equal time and at
/// equal error, where they are wrong, every number, and how it came about. `svg` is the chart;
/// where it is empty the page says `why_no_chart`.
std::string report_html(const Chart& chart, const ChartOrigin& origin, const std::string& svg,
                        const std::string& why_no_chart);

/// In a sentence or two: how what is chosen by itself fares against what is set by hand.
std::string automatic_lesson(const Chart& chart);

}  // namespace patchlight::server
