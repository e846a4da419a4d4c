#pragma once

#include "solver/scene/polygon.h"
#include "solver/solution.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace patchlight {

/// The field that pictures show, at any point of any surface: the triangle that holds the point is
/// found in a tree of boxes, one tree for each surface. Keeps a copy of what it needs, so the
/// solution may go.
class DisplayedField {
  public:
    DisplayedField(const Scene& scene, const PatchMesh& mesh, const DisplayMesh& display);
    DisplayedField(const Scene& scene, const Solution& solution)
        : DisplayedField(scene, solution.mesh, solution.display) {}

    /// Whether anything is displayed of a surface; nothing is where others cover all of it.
    bool shows(SurfaceIndex s) const { return !surfaces_[s].nodes.empty(); }

    /// Radiosity at a point on surface s, linear between the vertices of its triangle. A point that
    /// rounding, or a cover, has put beside all triangles takes the one it misses by least, as it
    /// is at its border. Zero where nothing is displayed [W/m²].
    Rgb radiosity(SurfaceIndex s, const Vec3& position) const;

    struct Place {
        std::uint32_t triangle = 0;      // of the display
        std::array<double, 3> weight{};  // of its corners, none below 0, sum 1
    };
    /// The triangle that is shown there, by the same rule; none where nothing is displayed.
    std::optional<Place> locate(SurfaceIndex s, const Vec3& position) const;

  private:
    struct Triangle {
        Triangle(std::uint32_t of_display, const std::array<Vec2, 3>& corners);
        /// Shares of the corners in a point; they sum to 1.
        std::array<double, 3> weights(const Vec2& p) const {
            const double u = first.dot(p - b), v = second.dot(p - c);
            return {u, v, 1.0 - u - v};
        }
        std::uint32_t number = 0;  // in the display
        Vec2 a, b, c;              // its corners in the surface's plane [m]
        Vec2 first, second;        // gradients of the shares of a and of b [1/m]
    };
    struct Node {
        Vec2 low, high;           // box round the triangles [m]
        std::uint32_t first = 0;  // triangle of a leaf; else number of the second child, the first
                                  // follows its parent
        std::uint32_t count = 0;  // triangles of a leaf; 0: two children
    };
    struct Sheet {
        PlaneFrame frame;
        std::vector<Triangle> triangles;
        std::vector<Node> nodes;  // the root first
    };
    struct Found {
        const Triangle* triangle = nullptr;
        std::array<double, 3> weight{};  // of its corners [1]
        double inside = 0.0;             // the least of them; below 0 outside [1]
    };

    static std::uint32_t grow(Sheet& sheet, std::uint32_t first, std::uint32_t last);
    static Found find(const Sheet& sheet, const Vec2& point, double slack);

    std::vector<Sheet> surfaces_;
    std::vector<Rgb> radiosity_;                          // at each vertex [W/m²]
    std::vector<std::array<std::uint32_t, 3>> vertices_;  // of each triangle
};

}  // namespace patchlight
