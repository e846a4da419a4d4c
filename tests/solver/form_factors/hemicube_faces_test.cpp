#include "solver/form_factors/hemicube_faces.h"

#include "solver/form_factors/hemicube_engine.h"
#include "tests/solver/form_factors/engine_scene.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace patchlight::hemicube_faces_test {
namespace {

constexpr double rounding = 1e-12;  // of sums over cells

std::vector<double> factors_of(const std::array<HemicubeFace, 5>& faces, std::size_t patches) {
    std::vector<double> factors(patches, 0.0);
    for (const HemicubeFace& face : faces)
        for (std::size_t cell = 0; cell < face.seen.size(); ++cell)
            if (face.seen[cell] < patches) factors[face.seen[cell]] += face.delta_factors[cell];
    return factors;
}

TEST(HemicubeFaces, DeltaFactorsOfAllFiveSumToOne) {
    const EngineScene pair(facing_squares(), 1.0);
    const auto faces = hemicube_faces(pair.cut.scene, pair.cut.mesh, pair.rays, 0, 32);
    double sum = 0.0;
    for (const HemicubeFace& face : faces) {
        ASSERT_EQ(face.seen.size(), static_cast<std::size_t>(face.width * face.height));
        ASSERT_EQ(face.delta_factors.size(), face.seen.size());
        for (const double delta : face.delta_factors) sum += delta;
    }
    EXPECT_NEAR(sum, 1.0, rounding);
}

/// From the centre of a unit square to one facing it at distance 1 the factor is four times that of
/// Howell's element under a corner: 0.2394565.
TEST(HemicubeFaces, OfFacingSquaresMeetTheFactorOfTheCentre) {
    const EngineScene pair(facing_squares(), 1.0);
    const auto faces = hemicube_faces(pair.cut.scene, pair.cut.mesh, pair.rays, 0, 64);
    constexpr double of_the_centre = 0.2394565, aliasing = 2e-3;  // cells of 1/64 along its edges
    EXPECT_NEAR(factors_of(faces, 2)[1], of_the_centre, aliasing);
    for (std::size_t face = 1; face < 5; ++face)
        EXPECT_TRUE(std::all_of(faces[face].seen.begin(), faces[face].seen.end(),
                                [](std::uint32_t seen) { return seen == HemicubeFace::nothing; }))
            << "the square is within 45 degrees of the normal";
}

/// The sides are told apart: from each of the four the patch in that direction has the most cells.
TEST(HemicubeFaces, SidesLookWhereTheySay) {
    const EngineScene cube(room(), 1.0);
    for (PatchIndex i = 0; i < cube.cut.mesh.size(); ++i) {
        const Patch& patch = cube.cut.mesh.patches[i];
        const auto faces = hemicube_faces(cube.cut.scene, cube.cut.mesh, cube.rays, i, 16);
        const Vec3 x = (cube.cut.mesh.vertices[patch.vertices[1]] -
                        cube.cut.mesh.vertices[patch.vertices[0]])
                           .normalized(),
                   normal = cube.cut.scene.surfaces[patch.surface].normal, y = normal.cross(x);
        const Vec3 ahead[] = {normal, x, -x, y, -y};
        for (std::size_t face = 0; face < 5; ++face) {
            // Low in the middle of a side, and in the middle of the top, one looks straight ahead.
            const HemicubeFace& each = faces[face];
            const int row = face == 0 ? each.height / 2 : each.height - 1;
            const std::uint32_t seen =
                each.seen[static_cast<std::size_t>(row * each.width + each.width / 2)];
            ASSERT_LT(seen, cube.cut.mesh.size());
            const Vec3& other = cube.cut.scene.surfaces[cube.cut.mesh.patches[seen].surface].normal;
            EXPECT_NEAR(other.dot(ahead[face]), -1.0, 1e-9) << "patch " << i << ", face " << face;
        }
    }
}

}  // namespace
}  // namespace patchlight::hemicube_faces_test
