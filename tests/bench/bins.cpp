#include "tests/bench/bins.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace patchlight {

namespace {

constexpr int deepest = 48;
constexpr int samples_of_covered = 4096;  // points a surface and bin, to find what is not covered

/// As many of equal weight would be as certain.
double effective_count(std::span<const Landed> landed) {
    double sum = 0.0, squares = 0.0;
    for (const Landed& one : landed) {
        sum += one.flux;
        squares += one.flux * one.flux;
    }
    return squares > 0.0 ? sum * sum / squares : 0.0;
}

/// Where half of the flux is on either side.
double middle(std::span<Landed> landed, Eigen::Index axis) {
    std::sort(landed.begin(), landed.end(),
              [axis](const auto& a, const auto& b) { return a.place[axis] < b.place[axis]; });
    double whole = 0.0, sum = 0.0;
    for (const Landed& one : landed) whole += one.flux;
    for (const Landed& one : landed)
        if ((sum += one.flux) >= 0.5 * whole) return one.place[axis];
    return landed.back().place[axis];
}

}  // namespace

Bins::Bins(const TracedScene& traced, std::span<Landed> landed, const BinSizes& sizes)
    : traced_(traced), sizes_(sizes) {
    const Scene& scene = traced.scene();
    std::sort(landed.begin(), landed.end(),
              [](const auto& a, const auto& b) { return a.surface < b.surface; });
    nodes_.resize(scene.surfaces.size());
    auto begin = landed.begin();
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s) {
        const auto end =
            std::find_if(begin, landed.end(), [s](const Landed& one) { return one.surface != s; });
        const bool reflects = (scene.materials[scene.surfaces[s].material].reflectance > 0.0).any();
        const FlatPolygon& flat = traced.flat(s);
        grow(s, s, {begin, end}, flat.low, flat.high, reflects ? sizes.largest_area : 1e300, 0);
        begin = end;
    }
    measure_areas();
}

void Bins::grow(std::uint32_t node, SurfaceIndex s, std::span<Landed> landed, const Vec2& low,
                const Vec2& high, double largest_area, int depth) {
    const double count =
        sizes_.whatever_weight ? static_cast<double>(landed.size()) : effective_count(landed);
    const bool many = count >= 2.0 * sizes_.landings;
    const bool large = (high - low).prod() > largest_area;
    if (depth == deepest || (!many && !large)) {
        nodes_[node].first = static_cast<std::uint32_t>(surface_.size());
        surface_.push_back(s);
        return;
    }
    const Eigen::Index axis = high.x() - low.x() >= high.y() - low.y() ? 0 : 1;
    double border = 0.5 * (low[axis] + high[axis]);
    if (many && !large) border = middle(landed, axis);
    const auto split = std::partition(landed.begin(), landed.end(),
                                      [&](const Landed& one) { return one.place[axis] < border; });
    const auto first = static_cast<std::uint32_t>(nodes_.size());
    nodes_[node] = {first, static_cast<int>(axis), border};
    nodes_.resize(nodes_.size() + 2);
    Vec2 middle_high = high, middle_low = low;
    middle_high[axis] = middle_low[axis] = border;
    grow(first, s, {landed.begin(), split}, low, middle_high, largest_area, depth + 1);
    grow(first + 1, s, {split, landed.end()}, middle_low, high, largest_area, depth + 1);
}

void Bins::measure_areas() {
    area_.resize(surface_.size());
    for (SurfaceIndex s = 0; s < traced_.scene().surfaces.size(); ++s)
        for (const auto& triangle : traced_.flat(s).triangles)
            integrate(s, triangle, {1.0, 1.0, 1.0}, area_);
    // A cover takes a share of the bins below it: points drawn in them tell which.
    std::vector<double> clear(surface_.size()), all(surface_.size());
    for (SurfaceIndex s = 0; s < traced_.scene().surfaces.size(); ++s) {
        if (!traced_.may_be_covered(s)) continue;
        const auto bins = static_cast<int>(std::count(surface_.begin(), surface_.end(), s));
        Random random(s, 0);
        for (int k = 0; k < samples_of_covered + 64 * bins; ++k) {
            const Vec2 place = traced_.flat(s).draw(random);
            const std::size_t at = bin(s, place);
            all[at] += 1.0;
            clear[at] += traced_.is_covered(s, traced_.flat(s).frame.lift(place)) ? 0.0 : 1.0;
        }
    }
    for (std::size_t k = 0; k < area_.size(); ++k)
        if (all[k] > 0.0) area_[k] *= std::max(1.0, clear[k]) / all[k];
}

std::size_t Bins::bin(SurfaceIndex s, const Vec2& place) const {
    std::uint32_t node = s;
    while (nodes_[node].axis >= 0)
        node = nodes_[node].first + (place[nodes_[node].axis] < nodes_[node].border ? 0 : 1);
    return nodes_[node].first;
}

void Bins::integrate(SurfaceIndex s, const std::array<Vec2, 3>& corners,
                     const std::array<double, 3>& values, std::span<double> sums) const {
    std::vector<Corner> polygon;
    for (std::size_t k = 0; k < 3; ++k) polygon.push_back({corners[k], values[k]});
    add(s, std::move(polygon), sums);
}

void Bins::add(std::uint32_t number, std::vector<Corner> polygon, std::span<double> sums) const {
    if (polygon.size() < 3) return;
    const Node& node = nodes_[number];
    if (node.axis < 0) {
        for (std::size_t k = 2; k < polygon.size(); ++k)
            sums[node.first] +=
                0.5 * std::abs(turn(polygon[0].place, polygon[k - 1].place, polygon[k].place)) *
                (polygon[0].value + polygon[k - 1].value + polygon[k].value) / 3.0;
        return;
    }
    const auto beyond = [&](const Corner& c) { return c.place[node.axis] - node.border; };
    std::vector<Corner> side[2];
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Corner &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
        const double at_p = beyond(p), at_q = beyond(q);
        if (at_p <= 0.0) side[0].push_back(p);
        if (at_p >= 0.0) side[1].push_back(p);
        if (at_p * at_q < 0.0) {
            const double share = at_p / (at_p - at_q);
            const Corner cut{p.place + share * (q.place - p.place),
                             p.value + share * (q.value - p.value)};
            side[0].push_back(cut);
            side[1].push_back(cut);
        }
    }
    add(node.first, std::move(side[0]), sums);
    add(node.first + 1, std::move(side[1]), sums);
}

}  // namespace patchlight
