#include "solver/display/flat_corners.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

namespace patchlight::flat_corners_test {
namespace {

/// A plate of 1 x 1 m as two quads side by side.
Scene plate(MaterialIndex material) {
    Scene scene = empty_scene();
    for (const double x : {0.0, 0.5})
        add(scene, rectangle({x, 0, 0}, 0.5 * Vec3::UnitX(), Vec3::UnitY()), material);
    return scene;
}

std::size_t corners_of(const Scene& scene) {
    const CutScene pieces = cut(scene, 10.0);
    return find_flat_corners(pieces.mesh, find_plane_groups(pieces.scene)).count;
}

TEST(FlatCorners, AreSharedByQuadsOfOnePlaneOnEachSide) {
    EXPECT_EQ(corners_of(plate(white)), 6u);
    EXPECT_EQ(corners_of(plate(two_sided)), 12u);
}

TEST(FlatCorners, AreApartWhereAWallStandsBetween) {
    for (const MaterialIndex material : {white, two_sided}) {
        Scene scene = plate(material);
        add(scene, rectangle({0.5, 0, 0}, Vec3::UnitY(), Vec3::UnitZ()), material);
        const std::size_t sides = material == two_sided ? 2 : 1;
        EXPECT_EQ(corners_of(scene), sides * (8u + 4u));
    }
}

}  // namespace
}  // namespace patchlight::flat_corners_test
