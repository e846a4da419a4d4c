#pragma once

#include "server/chart/chart.h"

#include <string>

namespace patchlight::server {

/// As HTML: what every series shows in the time `auto` takes at its middle accuracy, and where it
/// is wrong by how much.
std::string equal_time_figures(const Chart& chart);

/// As HTML: the quickest of every series that is as exact as all are, and what it took.
std::string equal_error_figures(const Chart& chart);

/// "3.1 %".
std::string percent(double share);

}  // namespace patchlight::server
