#include "solver/display/find_apertures.h"
#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace patchlight::find_apertures_test {
namespace {

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
constexpr int a_side = 5;                                 // holes of the ceiling
constexpr double room = 5.4, height = 3.4, hole = 0.009;  // [m]

double hole_at(int k) { return room * (k + 0.5) / a_side - 0.5 * hole; }

/// A room under a sky close above its ceiling, which has a grid of holes.
Scene perforated() {
    Scene scene = empty_scene();
    add(scene, rectangle({0, 0, 0}, room * x, room * y));
    add(scene, rectangle({0, 0, 0}, height * z, room * x));
    add(scene, rectangle({0, room, 0}, room * x, height * z));
    add(scene, rectangle({0, 0, 0}, room * y, height * z));
    add(scene, rectangle({room, 0, 0}, height * z, room * y));
    add(scene, rectangle({-0.2, -0.2, height + 0.014}, 5.8 * y, 5.8 * x), lamp);
    double left = 0.0;
    for (int i = 0; i <= a_side; ++i) {
        const double right = i < a_side ? hole_at(i) : room;
        add(scene, rectangle({left, 0, height}, room * y, (right - left) * x));
        left = right + hole;
        if (i == a_side) break;
        double from = 0.0;
        for (int j = 0; j <= a_side; ++j) {
            const double to = j < a_side ? hole_at(j) : room;
            add(scene, rectangle({right, from, height}, (to - from) * y, hole * x));
            from = to + hole;
        }
    }
    return scene;
}

/// Each seed finds all 25 holes: one that is missed takes a twenty-fifth of the light along. After
/// 128 lines through known ones a hole is missed by chance once in 190 runs; the seeds are fixed.
TEST(FindApertures, FindsEveryHoleOfAPerforation) {
    const CutScene pieces = cut(perforated(), 6.0);
    const RayScene rays(pieces.scene, pieces.lines.overlaps);
    const auto sources = find_light_sources(pieces.scene, pieces.lines, rays, 10);
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        const std::vector<Aperture> found = find_apertures(
            pieces.scene, rays, sources, find_lamp_reach(pieces.scene, rays, sources, seed), seed);
        for (int i = 0; i < a_side; ++i)
            for (int j = 0; j < a_side; ++j) {
                const RayPoint middle =
                    rays.to_ray_space({hole_at(i) + 0.5 * hole, hole_at(j) + 0.5 * hole, height});
                EXPECT_TRUE(
                    std::ranges::any_of(found,
                                        [&](const Aperture& aperture) {
                                            return (aperture.at(0.5f, 0.5f) - middle).norm() <
                                                   0.5 * hole * static_cast<double>(rays.scale());
                                        }))
                    << "seed " << seed << ", hole " << i << " " << j;
            }
    }
}

}  // namespace
}  // namespace patchlight::find_apertures_test
