#include "solver/rays/patch_locator.h"

#include "solver/scene/polygon.h"
#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>

namespace patchlight::patch_locator_test {
namespace {

constexpr double near_an_edge = 1e-5;  // of the scene's size: float cannot tell the side [1]

struct Shape {
    std::string name;
    Polygon polygon;
    friend std::ostream& operator<<(std::ostream& out, const Shape& shape) {
        return out << shape.name;
    }
};

/// The patch that holds the point; none if an edge is too near to tell.
std::optional<PatchIndex> holder(const CutScene& cut, SurfaceIndex s, const Vec3& p) {
    const PlaneFrame frame = frame_of(p, cut.scene.surfaces[s].normal);
    for (PatchIndex i = cut.mesh.first_of_surface[s]; i < cut.mesh.first_of_surface[s + 1]; ++i) {
        const std::vector<Vec3> corners = patch_corners(cut.mesh, i);
        double depth = 1e300;
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const Vec2 a = frame.flat(corners[k]),
                       b = frame.flat(corners[(k + 1) % corners.size()]);
            depth = std::min(depth, turn(a, b, Vec2::Zero()) / (b - a).norm());
        }
        if (depth > near_an_edge * scene_size(cut.scene)) return i;
    }
    return std::nullopt;
}

class LocatorOn : public testing::TestWithParam<Shape> {};

TEST_P(LocatorOn, FindsThePatchThatHoldsThePoint) {
    for (const Motion& motion : {Motion{}, Motion{1e-3, Vec3(2, -1, 4), odd_turn()}}) {
        const Scene scene =
            moved(scene_of({rectangle(Vec3(-1, -1, -1), Vec3::UnitX(), Vec3::UnitZ()),
                            GetParam().polygon}),
                  motion);
        const CutScene plate = cut(scene, 0.11 * motion.scale);
        const RayScene rays(plate.scene, plate.lines.overlaps);
        const PatchLocator locator(plate.scene, plate.mesh, rays);
        std::mt19937 chance(1);
        int asked = 0, wrong = 0;
        for (PatchIndex i = 0; i < plate.mesh.size(); ++i)
            for (int n = 0; n < 30; ++n) {
                const SurfaceIndex s = plate.mesh.patches[i].surface;
                const Vec3 p = random_point(plate.mesh, i, chance);
                const std::optional<PatchIndex> expected = holder(plate, s, p);
                if (!expected) continue;
                const RayPoint at = rays.to_ray_space(p);
                wrong += locator.find(s, at.x(), at.y(), at.z()) != *expected;
                ++asked;
            }
        EXPECT_EQ(wrong, 0);
        EXPECT_GT(asked, 29 * static_cast<int>(plate.mesh.size()));
    }
}

TEST_P(LocatorOn, GivesAPointBesideTheSurfaceToOneOfItsPatches) {
    const CutScene plate = cut(scene_of(GetParam().polygon), 0.3);
    const RayScene rays(plate.scene, plate.lines.overlaps);
    const PatchLocator locator(plate.scene, plate.mesh, rays);
    for (const Vec3& corner : GetParam().polygon)
        for (const Vec3& off : {Vec3(1e-6, 1e-6, 1e-6), Vec3(-1e-6, -1e-6, -1e-6)}) {
            const RayPoint at = rays.to_ray_space(corner + off);
            const PatchIndex found = locator.find(0, at.x(), at.y(), at.z());
            ASSERT_LT(found, plate.mesh.size());
            const std::vector<Vec3> p = patch_corners(plate.mesh, found);
            EXPECT_TRUE(std::any_of(p.begin(), p.end(), [&](const Vec3& q) {
                return (q - corner).norm() < 1e-9;
            })) << corner.transpose();
        }
}

INSTANTIATE_TEST_SUITE_P(
    PatchLocator, LocatorOn,
    testing::Values(Shape{"square", flat({{0, 0}, {1, 0}, {1, 1}, {0, 1}})},
                    Shape{"parallelogram", flat({{0, 0}, {1, 0}, {1.5, 0.8}, {0.5, 0.8}})},
                    Shape{"skewed_quad", flat({{0, 0}, {1.2, 0}, {1, 1}, {0.1, 0.7}})},
                    Shape{"triangle", flat({{0, 0}, {1, 0}, {0.3, 0.9}})}, Shape{"l", l_shape()},
                    Shape{"star", star(5, 0.4)}, Shape{"disk", regular(64, 1.0)},
                    Shape{"strip", flat({{0, 0}, {1, 0}, {1, 0.03}, {0, 0.04}})}),
    [](const auto& shape) { return shape.param.name; });

}  // namespace
}  // namespace patchlight::patch_locator_test
