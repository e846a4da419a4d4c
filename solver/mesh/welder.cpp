#include "solver/mesh/welder.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace patchlight {

namespace {

std::uint64_t cell_key(const std::array<std::int64_t, 3>& cell) {
    std::uint64_t key = 0x9e3779b97f4a7c15u;
    for (const std::int64_t c : cell) {
        key ^= static_cast<std::uint64_t>(c);
        key *= 0xbf58476d1ce4e5b9u;
        key ^= key >> 31;
    }
    return key;
}

}  // namespace

Welder::Welder(double reach) : reach_(std::max(reach, 1e-300)), cell_(16.0 * reach_) {}

std::uint32_t Welder::add(const Vec3& p) {
    // Cells that a ball of radius `reach` round p touches: one, unless p is near a cell's wall.
    std::array<std::int64_t, 3> low{}, high{};
    for (int axis = 0; axis < 3; ++axis) {
        low[static_cast<std::size_t>(axis)] = std::llround(std::floor((p[axis] - reach_) / cell_));
        high[static_cast<std::size_t>(axis)] = std::llround(std::floor((p[axis] + reach_) / cell_));
    }
    for (std::int64_t x = low[0]; x <= high[0]; ++x)
        for (std::int64_t y = low[1]; y <= high[1]; ++y)
            for (std::int64_t z = low[2]; z <= high[2]; ++z) {
                const auto [first, last] = cells_.equal_range(cell_key({x, y, z}));
                for (auto at = first; at != last; ++at)
                    if ((points_[at->second] - p).norm() <= reach_) return at->second;
            }
    const auto fresh = static_cast<std::uint32_t>(points_.size());
    points_.push_back(p);
    const auto cell_of = [&](int axis) { return std::llround(std::floor(p[axis] / cell_)); };
    cells_.emplace(cell_key({cell_of(0), cell_of(1), cell_of(2)}), fresh);
    return fresh;
}

}  // namespace patchlight
