#pragma once

#include "server/chart/chart.h"

#include <string>

namespace patchlight::server {

/// As HTML: every point, quickest first, those on the front in bold.
std::string points_table(const Chart& chart);

/// As HTML: what was skipped, and why; nothing if nothing was.
std::string skipped_table(const Chart& chart);

}  // namespace patchlight::server
