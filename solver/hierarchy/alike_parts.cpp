#include "solver/hierarchy/alike_parts.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>

namespace patchlight {

namespace {

/// Weight of squared differences of normals beside those of places over the scene's size: a radian
/// counts as much as a tenth of that size.
constexpr double normals_beside_places = 0.01;

/// Sides that face away from each other, as those of a thin wall, have nothing in common.
constexpr double opposed = 0.5;             // length of the mean normal: below, some are
constexpr double sooner_if_opposed = 10.0;  // times as likely to be cut

constexpr double rounding = 1e-14;  // of squared coordinates

}  // namespace

AlikeParts::AlikeParts(std::span<const FacingPlace> places) : order_(places.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    Vec3 mean = Vec3::Zero();
    double area = 0.0, square = 0.0;
    for (const FacingPlace& place : places) {
        area += place.area;
        mean += place.area * place.position;
    }
    if (area > 0.0) mean /= area;
    for (const FacingPlace& place : places)
        square += place.area * (place.position - mean).squaredNorm();
    const double size = square > 0.0 ? std::sqrt(square / area) : 1.0;
    for (const FacingPlace& place : places) {
        const Vec3 at = (place.position - mean) / size;
        const Vec3 facing = std::sqrt(normals_beside_places) * place.normal;
        at_.push_back({at.x(), at.y(), at.z(), facing.x(), facing.y(), facing.z()});
        area_.push_back(place.area);
    }
}

AlikeParts::Part AlikeParts::measure(std::size_t first, std::size_t end) const {
    Coordinates sum{}, square{};
    double area = 0.0;
    for (std::size_t k = first; k < end; ++k) {
        const double a = area_[order_[k]];
        const Coordinates& at = at_[order_[k]];
        area += a;
        for (std::size_t d = 0; d < at.size(); ++d) {
            sum[d] += a * at[d];
            square[d] += a * at[d] * at[d];
        }
    }
    Part part{0.0, first, end};
    if (end - first < 2) return part;
    double most = 0.0;
    for (std::size_t d = 0; d < sum.size(); ++d) {
        const double spread = std::max(0.0, square[d] - sum[d] * sum[d] / area);
        part.spread += spread;
        if (spread <= most) continue;
        most = spread;
        part.widest = d;
        part.middle = sum[d] / area;
    }
    if (part.spread <= rounding * area) part.spread = 0.0;
    double mean_normal = 0.0;
    for (std::size_t d = 3; d < sum.size(); ++d) mean_normal += sum[d] * sum[d];
    if (mean_normal < normals_beside_places * std::pow(opposed * area, 2))
        part.spread *= sooner_if_opposed;
    return part;
}

std::array<AlikeParts::Part, 2> AlikeParts::halves(const Part& part) {
    const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(part.first),
               end = order_.begin() + static_cast<std::ptrdiff_t>(part.end);
    auto middle = std::partition(
        begin, end, [&](std::uint32_t i) { return at_[i][part.widest] < part.middle; });
    if (middle == begin || middle == end) middle = begin + (end - begin) / 2;
    const auto cut = static_cast<std::size_t>(middle - order_.begin());
    return {measure(part.first, cut), measure(cut, part.end)};
}

std::vector<AlikeParts::Part> AlikeParts::cut(std::size_t most) {
    std::priority_queue<Part> queue;
    std::vector<Part> done;
    if (!order_.empty()) queue.push(measure(0, order_.size()));
    while (!queue.empty() && queue.size() + done.size() < most) {
        const Part widest = queue.top();
        queue.pop();
        if (!(widest.spread > 0.0)) {
            done.push_back(widest);
            continue;
        }
        for (const Part& half : halves(widest)) queue.push(half);
    }
    for (; !queue.empty(); queue.pop()) done.push_back(queue.top());
    std::sort(done.begin(), done.end(),
              [](const Part& a, const Part& b) { return a.first < b.first; });
    return done;
}

}  // namespace patchlight
