#include "solver/display/near_lights.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

namespace patchlight::near_lights_test {
namespace {

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY();

/// A floor of 4 m x 4 m in one patch, under or beside a lamp.
struct Floor {
    CutScene pieces;
    RayScene rays;
    std::vector<LightSource> sources;
    ApertureSet gaps;
    RefinementTree tree;
    NearLights lights;

    explicit Floor(const Polygon& lamp_at, const std::vector<Aperture>& of = {})
        : pieces(cut(with(lamp_at), 9.0)),
          rays(pieces.scene, pieces.lines.overlaps),
          sources(find_light_sources(pieces.scene, pieces.lines, rays, 10)),
          gaps(of, sources, rays),
          tree(pieces.mesh, find_flat_corners(pieces.mesh, find_plane_groups(pieces.scene))),
          lights(pieces.scene, pieces.mesh, rays, sources, gaps) {}
    static Scene with(const Polygon& lamp_at) {
        Scene scene = empty_scene();
        add(scene, rectangle(Vec3::Zero(), 4 * x, 4 * y));
        add(scene, lamp_at, lamp);
        return scene;
    }
    /// Cuts the floor until no element hides the lamp's spot; the smallest edge then.
    double finest(double little = 0.0) {
        double least = 4.0;
        for (std::uint32_t e = 0; e < tree.elements().size(); ++e) {
            const TreeElement element = tree.elements()[e];
            if (element.patch != 0) continue;
            const auto& v = tree.vertices();
            least = std::min(
                least, (v[element.vertices[1]].position - v[element.vertices[0]].position).norm());
            if (element.level < 12 && lights.may_hide_spot(tree, element, little)) tree.split(e);
        }
        return least;
    }
};

/// A square lamp above the point (1.3, 1.1), which faces the floor.
Polygon lamp_over(double height, double width) {
    return rectangle({1.3 - width / 2, 1.1 + width / 2, height}, width * x, -width * y);
}

TEST(NearLights, ALowLampIsNotBetweenTheCornersOfWhatItLights) {
    Floor floor(lamp_over(0.05, 0.2));
    EXPECT_TRUE(floor.lights.may_hide_spot(floor.tree, floor.tree.elements()[0], 0.0));
    const double finest = floor.finest();
    EXPECT_LE(finest, 2 * 0.1) << "half a diagonal within half the lamp's width";
    EXPECT_GE(finest, 0.5 * 0.1) << "and no finer than that";
    EXPECT_LT(floor.tree.elements().size(), 400u) << "only beside the lamp";
}

TEST(NearLights, AHighLampLightsAllOfIt) {
    Floor floor(lamp_over(3.0, 0.2));
    EXPECT_FALSE(floor.lights.may_hide_spot(floor.tree, floor.tree.elements()[0], 0.0));
}

TEST(NearLights, ALampThatFacesAwayOrStandsFarAsideLightsNoSpot) {
    Floor away(reversed(lamp_over(0.05, 0.2)));
    EXPECT_FALSE(away.lights.may_hide_spot(away.tree, away.tree.elements()[0], 0.0));
    Polygon beside = lamp_over(0.05, 0.2);
    for (Vec3& p : beside) p.x() += 9.0;
    Floor far(beside);
    EXPECT_FALSE(far.lights.may_hide_spot(far.tree, far.tree.elements()[0], 0.0));
}

TEST(NearLights, ALongLampCountsByItsNarrowSide) {
    Floor floor(rectangle({0.5, 1.2, 0.01}, 3.0 * x, -0.04 * y));
    const double finest = floor.finest();
    EXPECT_LE(finest, 2 * 0.02);
    EXPECT_GE(finest, 0.5 * 0.02);
}

/// A slit of a centimetre that stands on the floor, before a lamp that faces it.
TEST(NearLights, AGapCountsByItsWidthWhereItsLightIsWorthIt) {
    const Polygon lamp_at = rectangle({-0.5, 0.0, 0.0}, 2 * y, 2 * Vec3::UnitZ());
    const Floor before(lamp_at);
    const auto to = [&](const Vec3& p) { return before.rays.to_ray_space(p); };
    const RayPoint corner = to({1.0, 1.0, 0.0});
    const Aperture slit =
        make_aperture(corner, to({1.0, 1.01, 0.0}) - corner, to({1.0, 1.0, 1.0}) - corner);
    Floor floor(lamp_at, {slit});
    ASSERT_GT(floor.gaps.lit(0)[0].irradiance + floor.gaps.lit(0)[1].irradiance, 0.1);
    EXPECT_LE(floor.finest(), 0.02);
    EXPECT_LT(floor.tree.elements().size(), 400u) << "only beside the slit";
    Floor bright(lamp_at, {slit});
    EXPECT_GT(bright.finest(0.05), 0.02) << "so much light is not in a spot of a centimetre";
}

}  // namespace
}  // namespace patchlight::near_lights_test
