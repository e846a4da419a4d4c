#include "server/chart/chart.h"

#include "server/chart/pareto_front.h"

#include <algorithm>

namespace patchlight::server {

namespace {
constexpr double near_floor = 2.0;  // times the reference's own error: half of it may be that
}

void mark_points(Chart& chart) {
    std::stable_sort(
        chart.points.begin(), chart.points.end(),
        [](const ChartPoint& a, const ChartPoint& b) { return a.seconds < b.seconds; });
    const double floor =
        chart.reference ? near_floor * chart.reference->estimate.value_or(0.0) : 0.0;
    std::vector<SpeedAndError> measured;
    std::vector<ChartPoint*> which;
    for (ChartPoint& point : chart.points) {
        point.is_on_front = false;
        point.is_at_floor = point.error && *point.error < floor;
        if (!point.error) continue;
        measured.push_back({point.seconds, *point.error});
        which.push_back(&point);
    }
    for (const std::size_t k : pareto_front(measured)) which[k]->is_on_front = true;
}

}  // namespace patchlight::server
