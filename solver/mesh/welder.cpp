#include "solver/mesh/welder.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace patchlight {

namespace {

constexpr double cell_edge = 16.0;  // of the reach [1]

std::uint64_t cell_key(const std::array<std::int64_t, 3>& cell, std::size_t frame) {
    std::uint64_t key = 0x9e3779b97f4a7c15u + frame;
    for (const std::int64_t c : cell) {
        key ^= static_cast<std::uint64_t>(c);
        key *= 0xbf58476d1ce4e5b9u;
        key ^= key >> 31;
    }
    return key;
}

}  // namespace

Welder::Welder(std::vector<double> reach_of_frame) : reach_(std::move(reach_of_frame)) {
    for (double& reach : reach_) reach = std::max(reach, 1e-300);
}

std::uint32_t Welder::add(const Vec3& p, std::size_t frame) {
    const double reach = reach_[frame], cell = cell_edge * reach;
    std::uint64_t exact_key = 0;
    if (reach_.size() > 1) {
        std::array<std::int64_t, 3> bits{};
        for (std::size_t axis = 0; axis < 3; ++axis)  // + 0: no negative zero
            bits[axis] = std::bit_cast<std::int64_t>(p[static_cast<Eigen::Index>(axis)] + 0.0);
        exact_key = cell_key(bits, 0);
        const auto [first, last] = exact_.equal_range(exact_key);
        for (auto at = first; at != last; ++at)
            if (points_[at->second] == p) return at->second;
    }
    // Cells that a ball of radius `reach` round p touches: one, unless p is near a cell's wall.
    std::array<std::int64_t, 3> low{}, high{};
    for (int axis = 0; axis < 3; ++axis) {
        low[static_cast<std::size_t>(axis)] = std::llround(std::floor((p[axis] - reach) / cell));
        high[static_cast<std::size_t>(axis)] = std::llround(std::floor((p[axis] + reach) / cell));
    }
    for (std::int64_t x = low[0]; x <= high[0]; ++x)
        for (std::int64_t y = low[1]; y <= high[1]; ++y)
            for (std::int64_t z = low[2]; z <= high[2]; ++z) {
                const auto [first, last] = cells_.equal_range(cell_key({x, y, z}, frame));
                for (auto at = first; at != last; ++at)
                    if ((points_[at->second] - p).norm() <= reach) return at->second;
            }
    const auto fresh = static_cast<std::uint32_t>(points_.size());
    points_.push_back(p);
    const auto cell_of = [&](int axis) { return std::llround(std::floor(p[axis] / cell)); };
    cells_.emplace(cell_key({cell_of(0), cell_of(1), cell_of(2)}, frame), fresh);
    if (reach_.size() > 1) exact_.emplace(exact_key, fresh);
    return fresh;
}

}  // namespace patchlight
