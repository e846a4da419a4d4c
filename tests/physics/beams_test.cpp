#include "solver/form_factors/point_factor.h"
#include "tests/physics/rooms.h"

#include <Eigen/Geometry>

#include <cmath>

namespace patchlight::beams_test {
namespace {

constexpr double width = 4.0, depth = 5.0, height = 3.0;  // of the room [m]
constexpr double exitance = 4e6;                          // of the sun [W/m²]

struct BeamRoom {
    SceneBuilder builder;
    double flux = 0.0;  // through the hole [W]

    /// A black room with a grey floor, and a sun of half a degree over a square hole in a wall.
    BeamRoom(double hole, const Vec3& centre) {
        const MaterialIndex black = builder.material(0.0, 0.0), grey = builder.material(0.5, 0.0),
                            sun = builder.material(0.0, exitance);
        builder.box("room", black, Vec3::Zero(), {width, depth, height}, true,
                    Eigen::Isometry3d::Identity(), 0);
        builder.scene.surfaces.erase(
            std::remove_if(builder.scene.surfaces.begin(), builder.scene.surfaces.end(),
                           [](const Surface& s) { return s.normal.x() > 0.9; }),
            builder.scene.surfaces.end());
        builder.polygon("floor", grey,
                        {{0, 0, 0}, {width, 0, 0}, {width, depth, 0}, {0, depth, 0}});
        const double y0 = centre.y() - hole / 2, y1 = centre.y() + hole / 2,
                     z0 = centre.z() - hole / 2, z1 = centre.z() + hole / 2;
        const auto board = [&](double ya, double yb, double za, double zb) {
            builder.polygon("board", black, {{0, ya, za}, {0, yb, za}, {0, yb, zb}, {0, ya, zb}});
        };
        board(0, y0, 0, height);
        board(y1, depth, 0, height);
        board(y0, y1, 0, z0);
        board(y0, y1, z1, height);
        const Vec3 towards = Vec3(-2.0, 0.3, 1.9).normalized(), middle = centre + 30.0 * towards;
        const Vec3 u = towards.cross(Vec3::UnitZ()).normalized(), v = towards.cross(u);
        const double half = 30.0 * 0.0046;
        const std::vector<Vec3> corners{middle - half * u - half * v, middle - half * u + half * v,
                                        middle + half * u + half * v, middle + half * u - half * v};
        builder.polygon("sun", sun, corners);
        ConvexPolygon seen;
        for (const Vec3& p : corners) seen.add(p);
        const Vec3 faces = builder.scene.surfaces.back().normal;
        flux = exitance * hole * hole * point_factor(centre, -Vec3::UnitX(), seen, faces);
    }
};

/// Sunbeams through holes from 1 to 4 cm: all their light lies in one spot of the floor, whose
/// flux is known by Lambert's formula (the hole's middle stands for it to 1e-6).
TEST(Beams, OfASunThroughAHoleBringTheirFlux) {
    for (const double hole : {0.01, 0.019, 0.04})
        for (const double accuracy : {0.1}) {
            const BeamRoom room(hole, {0.0, 2.1 + hole, 2.0});
            ASSERT_GT(room.flux, 0.0);
            SolveSettings settings;
            settings.accuracy = accuracy;
            const Solution solution = solve(room.builder.scene, settings);
            ASSERT_TRUE(solution.error.estimate) << hole << " " << accuracy;
            EXPECT_EQ(solution.status, Status::converged) << hole << " " << accuracy;
            double floor = 0.0;
            for (PatchIndex i = 0; i < solution.mesh.size(); ++i)
                floor +=
                    solution.mesh.patches[i].area * luminance(solution.irradiance[i]) *
                    (room.builder.scene.surfaces[solution.mesh.patches[i].surface].normal.z() > 0.9
                         ? 1.0
                         : 0.0);
            // In a spot of about one brightness the flux is no more wrong than the field.
            EXPECT_NEAR(floor, room.flux, 1.5 * *solution.error.estimate * room.flux)
                << hole << " " << accuracy;
        }
}

}  // namespace
}  // namespace patchlight::beams_test
