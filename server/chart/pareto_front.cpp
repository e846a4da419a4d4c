#include "server/chart/pareto_front.h"

#include <algorithm>
#include <numeric>

namespace patchlight::server {

std::vector<std::size_t> pareto_front(std::span<const SpeedAndError> points) {
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        if (points[a].seconds != points[b].seconds) return points[a].seconds < points[b].seconds;
        return points[a].error < points[b].error;
    });
    std::vector<std::size_t> front;
    for (const std::size_t k : order)
        if (front.empty() || points[k].error < points[front.back()].error) front.push_back(k);
    return front;
}

}  // namespace patchlight::server
