#pragma once

#include "solver/scene/light.h"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace patchlight {

/// Gives points of a frame that are closer than its `reach` one number, and points of different
/// frames if they are the same exactly: hashing on a grid of cells, so each costs O(1).
class Welder {
  public:
    explicit Welder(std::vector<double> reach_of_frame);
    std::uint32_t add(const Vec3& p, std::size_t frame);
    std::vector<Vec3> take_points() { return std::move(points_); }

  private:
    std::vector<double> reach_;  // per frame
    std::unordered_multimap<std::uint64_t, std::uint32_t> cells_;
    std::unordered_multimap<std::uint64_t, std::uint32_t> exact_;  // where there are several frames
    std::vector<Vec3> points_;
};

}  // namespace patchlight
