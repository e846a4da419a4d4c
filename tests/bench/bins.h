#pragma once

#include "tests/bench/traced_scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace patchlight {

/// Light that landed on a front and is reflected, luminance.
struct Landed {
    SurfaceIndex surface = 0;
    Vec2 place = Vec2::Zero();  // in the surface's plane [m]
    double flux = 0.0;          // [W]
};

struct BinSizes {
    double landings = 100.0;       // a bin with twice as many, of even weight, is halved
    double largest_area = 1e300;   // and one that is larger, where the surface reflects [m²]
    bool whatever_weight = false;  // landings count alike
};

/// Rectangles that cover every surface, small where much light landed.
class Bins {
  public:
    Bins(const TracedScene& traced, std::span<Landed> landed, const BinSizes& sizes);

    std::size_t size() const { return area_.size(); }
    double area(std::size_t bin) const { return area_[bin]; }
    SurfaceIndex surface(std::size_t bin) const { return surface_[bin]; }
    std::size_t bin(SurfaceIndex s, const Vec2& place) const;

    /// Adds the integral over each bin of what runs linearly between the corners of a triangle in
    /// the plane of surface s.
    void integrate(SurfaceIndex s, const std::array<Vec2, 3>& corners,
                   const std::array<double, 3>& values, std::span<double> sums) const;

  private:
    struct Node {
        std::uint32_t first = 0;  // child, the second follows it; of a leaf its bin
        int axis = -1;            // -1: a leaf
        double border = 0.0;
    };
    struct Corner {
        Vec2 place;
        double value;
    };
    void grow(std::uint32_t node, SurfaceIndex s, std::span<Landed> landed, const Vec2& low,
              const Vec2& high, double largest_area, int depth);
    void measure_areas();
    void add(std::uint32_t node, std::vector<Corner> polygon, std::span<double> sums) const;

    const TracedScene& traced_;
    BinSizes sizes_;
    std::vector<Node> nodes_;  // those of surfaces first
    std::vector<double> area_;
    std::vector<SurfaceIndex> surface_;
};

}  // namespace patchlight
