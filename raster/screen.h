#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>

namespace patchlight::raster {

/// Pixels of a picture; (0, 0) is its top left corner, y runs down.
struct Viewport {
    int width = 0;
    int height = 0;
};

/// A point in multiples of 1/256 pixel.
struct FixedPoint {
    std::int32_t x = 0;
    std::int32_t y = 0;
};

/// A corner after the division by w. Nearness is (z + 1) / w: linear on the screen, at least 1,
/// growing towards the eye, and equally fine for far and for near things in single precision
/// (z / w alone would leave next to nothing for the far ones).
struct ScreenVertex {
    double x = 0.0;  // [pixels]
    double y = 0.0;  // [pixels]
    double nearness = 0.0;
    double inverse_w = 0.0;
    FixedPoint snapped;
};

/// Of two things whose nearness differs by less than this share, about a millionth of the depth,
/// the one drawn later is seen: coplanar polygons are told apart by their order, not by rounding.
inline constexpr float nearness_tie = 1.0F / (1 << 20);

/// Where a point of the canonical volume lies on the screen. Outside it the result is meaningless
/// but for the empty result when a number is not finite.
std::optional<ScreenVertex> screen_vertex(const Eigen::Vector4d& position,
                                          const Viewport& viewport);

/// True if the corners run counter-clockwise as the eye sees them (also with corners behind it).
bool faces_eye(const Eigen::Vector4d& a, const Eigen::Vector4d& b, const Eigen::Vector4d& c);

/// Twice the area on the 1/256 pixel grid, positive if the corners run clockwise on the screen.
inline std::int64_t turn(const FixedPoint& a, const FixedPoint& b, const FixedPoint& c) {
    return std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{c.x - a.x} * (b.y - a.y);
}

/// A quantity that is linear on the screen.
struct ScreenPlane {
    double at_origin = 0.0;
    double dx = 0.0;  // change per pixel to the right
    double dy = 0.0;  // change per pixel down

    double at(double x, double y) const { return at_origin + dx * x + dy * y; }
};

/// Fits planes through three corners. Computed from the corners before snapping: coplanar
/// triangles cut differently then have the same planes up to rounding.
class PlaneFit {
  public:
    PlaneFit(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c);
    ScreenPlane through(double value_a, double value_b, double value_c) const;

  private:
    double x_, y_;        // corner a
    double b_dx_, c_dx_;  // weights of the two differences in dx
    double b_dy_, c_dy_;
};

}  // namespace patchlight::raster
