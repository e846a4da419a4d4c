#include "solver/display/aperture_set.h"

#include "solver/form_factors/point_factor.h"
#include "solver/rays/low_discrepancy.h"
#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patchlight::aperture_set_test {
namespace {

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

/// A lamp 2 m up, and holes of all sizes and directions below it.
struct Holes {
    CutScene pieces;
    RayScene rays;
    std::vector<LightSource> sources;
    std::vector<Aperture> holes;

    Holes()
        : pieces(cut(scene(), 9.0)),
          rays(pieces.scene, pieces.lines.overlaps),
          sources(find_light_sources(pieces.scene, pieces.lines, rays, 10)) {
        for (std::uint64_t k = 0; k < 50; ++k) {
            const auto number = [&](std::uint64_t n) {
                return static_cast<float>(unit(mix(k, n))) - 0.5f;
            };
            const RayPoint normal = RayPoint(number(0), number(1), number(2)).normalized(),
                           first = normal.unitOrthogonal(), second = normal.cross(first);
            const float size = 0.2f * std::pow(10.0f, 2.0f * number(3) - 1.0f);
            holes.push_back(make_aperture(RayPoint(number(4), number(5), number(6)), size * first,
                                          (k % 2 == 0 ? 1.0f : 8.0f) * size * second));
        }
    }
    static Scene scene() {
        Scene scene = empty_scene();
        add(scene, rectangle({-1, -1, -1}, 2 * x, 2 * y));
        add(scene, rectangle({0.2, 0.3, 2}, 0.1 * y, 0.1 * x), lamp);
        return scene;
    }
};

TEST(ApertureSet, CountsWhatEachSaysItself) {
    const Holes of;
    const ApertureSet set(of.holes, of.sources, of.rays);
    int all = 0;
    for (std::uint64_t k = 0; k < 2000; ++k) {
        const auto number = [&](std::uint64_t n) {
            return 2.0f * static_cast<float>(unit(mix(k, 100 + n))) - 1.0f;
        };
        const RayPoint from(number(0), number(1), number(2)),
            ray = RayPoint(number(3), number(4), number(5)) - from;
        int expected = 0;
        for (const Aperture& hole : of.holes) expected += hole.crosses(from, ray);
        ASSERT_EQ(set.count_crossed(from, ray), expected) << k;
        all += expected;
    }
    EXPECT_GT(all, 100) << "enough of them crossed any";
    EXPECT_EQ(ApertureSet().count_crossed({0, 0, 0}, {1, 0, 0}), 0);
}

/// By lines from a point through each hole: those that go on to the lamp bring so much light.
TEST(ApertureSet, NoMoreComesThroughThanIsSaid) {
    const Holes of;
    const ApertureSet set(of.holes, of.sources, of.rays);
    const LightSource& source = of.sources[0];
    std::vector<float> most(set.size());
    int lit = 0, none = 0;
    for (std::uint64_t k = 0; k < 200; ++k) {
        const auto number = [&](std::uint64_t n) {
            return static_cast<float>(unit(mix(k, 200 + n))) - 0.5f;
        };
        const RayPoint at(number(0), number(1), number(2)), normal = RayPoint::UnitZ();
        set.most_through(at, normal, most);
        for (std::size_t g = 0; g < set.size(); ++g) {
            double sum = 0.0;
            constexpr int n = 12;
            for (int i = 0; i < n * n; ++i) {
                const Aperture::Pick pick =
                    of.holes[g].pick_from(at, (static_cast<float>(i % n) + 0.5f) / n,
                                          (static_cast<float>(i / n) + 0.5f) / n);
                const RayPoint ray = pick.point - at;
                const Vec3 from = of.rays.from_ray_space(at.cast<double>()),
                           way = ray.cast<double>() / of.rays.scale();
                const double along = way.z();
                if (!(along > 0.0)) continue;
                const double t = (2.0 - from.z()) / along;
                const Vec3 met = from + t * way;
                if (t <= 1.0 || met.x() < 0.2 || met.x() > 0.3 || met.y() < 0.3 || met.y() > 0.4)
                    continue;
                const double squared = static_cast<double>(ray.squaredNorm());
                sum += static_cast<double>(std::max(0.0f, ray.dot(normal)) *
                                           std::abs(ray.dot(of.holes[g].normal)) * pick.area) /
                       (squared * squared * M_PI * n * n);
            }
            const double light = sum * luminance(source.exitance);
            EXPECT_LE(light, 1.0001 * static_cast<double>(most[g])) << k << " " << g;
            lit += light > 0.0;
            none += most[g] == 0.0f;
        }
    }
    EXPECT_GT(lit, 20);
    EXPECT_GT(none, 5000) << "through most of them no lamp is seen, and that is known";
}

TEST(ApertureSet, ALampFarOffIsSeenThroughTheHoleInLineWithIt) {
    const Holes of;
    // A hole of 2 mm right below the lamp's middle, seen from 1 m farther below: angles so small
    // that their cosines are 1 in float.
    const RayPoint lamp_at = of.rays.to_ray_space({0.25, 0.35, 2.0}),
                   hole_at = of.rays.to_ray_space({0.25, 0.35, 0.0}),
                   below = of.rays.to_ray_space({0.25, 0.35, -1.0}),
                   beside = of.rays.to_ray_space({0.45, 0.35, -1.0});
    const float side = static_cast<float>(0.002 * of.rays.scale());
    const Aperture hole =
        make_aperture(hole_at - RayPoint(side / 2, side / 2, 0), {side, 0, 0}, {0, side, 0});
    const ApertureSet set({hole}, of.sources, of.rays);
    std::array<float, 1> most{};
    set.most_through(below, (lamp_at - below).normalized(), most);
    const double factor = 0.002 * 0.002 / M_PI;
    EXPECT_NEAR(static_cast<double>(most[0]), factor * luminance(of.sources[0].exitance),
                0.02 * factor * luminance(of.sources[0].exitance));
    set.most_through(beside, RayPoint::UnitZ(), most);
    EXPECT_EQ(most[0], 0.0f);
}

TEST(ApertureSet, PicksStandForTheWholeOfASlitAtAnyDistance) {
    const Aperture slit = make_aperture({0, 0, 0}, {0.001f, 0, 0}, {0, 1, 0});
    for (const float height : {1e-3f, 1e-2f, 1.0f}) {
        double area = 0.0, near = 0.0;
        constexpr int n = 4096;
        const RayPoint from(0.0f, 0.3f, height);
        for (int k = 0; k < n; ++k) {
            const Aperture::Pick pick = slit.pick_from(from, (static_cast<float>(k) + 0.5f) / n,
                                                       static_cast<float>(k % 64) / 64.0f);
            area += static_cast<double>(pick.area) / n;
            near += (pick.point - from).norm() < 3.0f * height ? 1.0 / n : 0.0;
            EXPECT_TRUE(pick.point.y() >= 0.0f && pick.point.y() <= 1.0f);
        }
        EXPECT_NEAR(area, 0.001, 0.05 * 0.001) << height;
        EXPECT_GT(near, 0.5) << height << ": most of them are near";
    }
}

}  // namespace
}  // namespace patchlight::aperture_set_test
