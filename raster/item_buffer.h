#pragma once

#include "raster/project.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace patchlight::raster {

/// A picture of who is seen instead of how bright: for each pixel the item of the triangle that is
/// nearest at its centre. Kept and refilled, as a hemicube does for each of its faces.
class ItemBuffer {
  public:
    static constexpr std::uint32_t nothing = 0xffffffff;

    /// Up to 16384 pixels an edge, else throws std::invalid_argument. Starts empty.
    ItemBuffer(int width, int height);

    /// Back to `nothing` everywhere.
    void clear();

    /// Draws triangles, both sides of them, over what is there. `positions` lie in the space of
    /// the canonical volume (canonical_from_world * point) and are clipped here; items[t] is the
    /// item of triangles[t]. Of coplanar triangles the one drawn last is seen.
    void draw(std::span<const Eigen::Vector4d> positions,
              std::span<const std::array<std::uint32_t, 3>> triangles,
              std::span<const std::uint32_t> items);

    /// Row by row, top row first. Size: width * height.
    std::span<const std::uint32_t> items() const { return items_; }
    const Viewport& viewport() const { return viewport_; }

  private:
    void draw_on_screen(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c,
                        std::uint32_t item);

    Viewport viewport_;
    std::vector<float> nearness_;
    std::vector<std::uint32_t> items_;
    std::vector<ProjectedVertex> vertices_;  // of the draw in hand
};

}  // namespace patchlight::raster
