#pragma once

#include "solver/scene/light.h"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace patchlight {

/// Gives points closer than `reach` one number: hashing on a grid of cells, so each costs O(1).
class Welder {
  public:
    explicit Welder(double reach);
    std::uint32_t add(const Vec3& p);
    std::vector<Vec3> take_points() { return std::move(points_); }

  private:
    double reach_;
    double cell_;  // edge of a cell, several `reach` [m]
    std::unordered_multimap<std::uint64_t, std::uint32_t> cells_;
    std::vector<Vec3> points_;
};

}  // namespace patchlight
