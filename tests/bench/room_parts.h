#pragma once

#include "tests/bench/random.h"
#include "tests/bench/scene_text.h"

#include <string>
#include <utility>
#include <vector>

namespace patchlight {

/// What rooms of the claim bench are made of; z is up, lengths in metres before the transform.
class RoomParts {
  public:
    explicit RoomParts(std::uint64_t seed, std::uint64_t stream) : random(seed, stream) {}

    Random random;
    SceneText text;

    double between(double low, double high) { return random.uniform(low, high); }
    /// Evenly in the logarithm.
    double across(double low, double high);

    /// Grey, or coloured, of a mean reflectance in a range.
    std::string paint(double low = 0.15, double high = 0.85, bool two_sided = false);
    /// One that gives light.
    std::string lamp_paint(double radiance, bool two_sided = false);
    /// Half of all scenes are made from 10 times smaller to 10 times larger.
    void choose_scale();

    enum Side : unsigned { floor = 1, ceiling = 2, x0 = 4, x1 = 8, y0 = 16, y1 = 32, all = 63 };
    /// Fronts inward; one paint or one of each.
    void room(const Vec3& size, unsigned sides = all, double low = 0.2, double high = 0.85);
    void room_at(const Vec3& origin, const Vec3& size, unsigned sides,
                 const std::vector<std::string>& paints);
    std::vector<std::string> room_paints(double low, double high);

    /// Fronts outward, turned about z.
    void box(const std::string& name, const std::string& material, const Vec3& centre,
             const Vec3& size, double angle = 0.0);
    /// Up to so many boxes on the floor of a room or in mid-air.
    void boxes(const Vec3& room, int count, double low = 0.15, double high = 0.85);
    /// A rectangle near the ceiling; some face up.
    void ceiling_lamp(const Vec3& room, double radiance, bool may_face_up = false);

    /// Open strips across a sheet, from and to along b; each with the pieces that fill it, from and
    /// to along a.
    struct Row {
        double from, to;
        std::vector<std::pair<double, double>> filled;
    };
    /// A rectangle from o along the edges a and b, its front where a × b points, less the rows.
    void sheet(const std::string& name, const std::string& material, const Vec3& o, const Vec3& a,
               const Vec3& b, std::vector<Row> rows);
    /// A row with openings from and to along a, of a sheet so long.
    static Row row(double from, double to, double length,
                   const std::vector<std::pair<double, double>>& open);

    /// A surface of revolution about an axis through `at` along z, from radii and heights; fronts
    /// outward if heights rise.
    void revolved(const std::string& name, const std::string& material, const Vec3& at,
                  const std::vector<std::pair<double, double>>& profile, int sides, bool triangles);
};

}  // namespace patchlight
