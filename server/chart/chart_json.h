#pragma once

#include "server/chart/chart.h"
#include "server/chart/chart_origin.h"

#include <nlohmann/json.hpp>

namespace patchlight::server {

/// All that was measured, where and against what. Absent quantities are absent.
nlohmann::ordered_json chart_json(const Chart& chart, const ChartOrigin& origin);

}  // namespace patchlight::server
