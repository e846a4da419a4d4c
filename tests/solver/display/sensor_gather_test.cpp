#include "solver/display/sensor_gather.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace patchlight::sensor_gather_test {
namespace {

constexpr double element_tolerance = 1e-6;  // Lambert's formula, and no ray to add noise

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

struct Seen {
    Vec3 at, normal;
};

/// Irradiance from the polygons of `scene` whose material is `lamp`, of radiosity (1, 2, 4).
std::vector<SensorReport> gather(Scene scene, const std::vector<Seen>& sensors, double patch_size,
                                 std::uint64_t seed = 1) {
    for (const Seen& seen : sensors) scene.sensors.push_back({"", seen.at, seen.normal});
    const CutScene lit = cut(scene, patch_size);
    std::vector<Rgb> radiosity;
    for (const Patch& patch : lit.mesh.patches)
        radiosity.push_back(lit.scene.surfaces[patch.surface].material == lamp ? Rgb(1, 2, 4)
                                                                               : Rgb(0, 0, 0));
    const RayScene rays(lit.scene, lit.lines.overlaps);
    return gather_at_sensors(lit.scene, lit.mesh, rays, radiosity, seed);
}

Scene lit_by(const Polygon& polygon) {
    Scene scene = empty_scene();
    add(scene, polygon, lamp);
    return scene;
}

struct Element {
    std::string name;
    Seen sensor;
    Polygon light;
    double exact;
    friend std::ostream& operator<<(std::ostream& out, const Element& e) { return out << e.name; }
};

class Elements : public testing::TestWithParam<Element> {};

TEST_P(Elements, MatchTheClosedForm) {
    const Element& element = GetParam();
    for (const double patch_size : {9.0, 0.3}) {
        const SensorReport report = gather(lit_by(element.light), {element.sensor}, patch_size)[0];
        EXPECT_NEAR(report.irradiance[0], element.exact, element_tolerance) << patch_size;
        EXPECT_NEAR(report.irradiance[1], 2 * element.exact, 2 * element_tolerance);
        EXPECT_NEAR(report.irradiance[2], 4 * element.exact, 4 * element_tolerance);
        EXPECT_EQ(report.error, 0.0);
    }
}

// Howell, "A Catalog of Radiation Configuration Factors", section B; the triangle: Lambert's sum.
INSTANTIATE_TEST_SUITE_P(
    SensorGather, Elements,
    testing::Values(
        Element{"corner",
                {Vec3::Zero(), z},
                {{0, 1, 1}, {1, 1, 1}, {1, 0, 1}, {0, 0, 1}},
                0.138531605994892997},
        Element{"centre",
                {Vec3::Zero(), z},
                {{-1, 1, 1}, {1, 1, 1}, {1, -1, 1}, {-1, -1, 1}},
                0.554126423979571987},
        Element{"perpendicular",
                {x, z},
                {{0, 0, 0}, {0, 1, 0}, {0, 1, 2}, {0, 0, 2}},
                0.0950679411924033076},
        Element{"horizon",
                {x, z},
                {{0, 0, -2}, {0, 1, -2}, {0, 1, 2}, {0, 0, 2}},
                0.0950679411924033076},
        Element{"disk", {Vec3::Zero(), z}, reversed(regular(64, 1.0, 1.0)), 0.499598211234437589},
        Element{"tilted",
                {Vec3::Zero(), Vec3(0.309426373877638, -0.20628424925175867, 0.928279121632914)},
                {{0.2, 0.6, 2.1}, {-0.7, 0.9, 0.5}, {1.2, -0.4, 0.3}},
                0.125711158449812246}),
    [](const auto& element) { return element.param.name; });

TEST(SensorGather, SeesNothingBehindItNorBacks) {
    const Polygon above = rectangle(z, y, x);
    EXPECT_EQ(gather(lit_by(above), {{Vec3(0.5, 0.5, 0), -z}}, 9.0)[0].irradiance[0], 0.0);
    EXPECT_EQ(gather(lit_by(reversed(above)), {{Vec3(0.5, 0.5, 0), z}}, 9.0)[0].irradiance[0], 0.0);
}

TEST(SensorGather, PenumbraOfASquareScreen) {
    // Light 1 × 1 at z = 2, screen 0.5 × 0.5 at z = 1, sensors along the floor; exact by Lambert's
    // formula on the visible polygon.
    const std::vector<std::pair<double, double>> visible{{0.0, 0.0},
                                                         {0.1, 0.007202233318078566},
                                                         {0.2, 0.014969303410759638},
                                                         {0.3, 0.022819811115860733},
                                                         {0.4, 0.03023193216055807},
                                                         {0.5, 0.03673881740626068},
                                                         {0.6, 0.042006289390557616},
                                                         {0.7, 0.04586863423370737},
                                                         {0.8, 0.04831980486405928},
                                                         {0.9, 0.04947490058329734},
                                                         {1.0, 0.049521835725815457}};
    const double one_percent = 0.01 * 0.0735;  // of what the floor receives with no screen
    Scene scene = lit_by(rectangle(Vec3(-0.5, -0.5, 2), y, x));
    add(scene, rectangle(Vec3(-0.25, -0.25, 1), 0.5 * x, 0.5 * y));
    std::vector<Seen> sensors;
    for (const auto& [at, factor] : visible) sensors.push_back({at * x, z});
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        const std::vector<SensorReport> reports = gather(scene, sensors, 0.25, seed);
        for (std::size_t k = 0; k < visible.size(); ++k) {
            EXPECT_NEAR(reports[k].irradiance[0], visible[k].second, one_percent) << k;
            // The error stated is of the luminance, 1.86 times the red; 4 sigma: 1 in 16 000.
            EXPECT_NEAR(reports[k].irradiance[0], visible[k].second,
                        4 * reports[k].error + element_tolerance)
                << k;
        }
    }
}

TEST(SensorGather, OnTheFloorIsNotHiddenByIt) {
    Scene scene = lit_by(rectangle(z, y, x));
    add(scene, rectangle(Vec3(-1, -1, 0), 3.0 * x, 3.0 * y));
    const double reach = 1e-6 * scene_size(scene);
    const std::vector<SensorReport> reports = gather(scene,
                                                     {{Vec3(0, 0, 0), z},
                                                      {Vec3(0, 0, -0.9 * reach), z},
                                                      {Vec3(0, 0, 1e-3), z},
                                                      {Vec3(0, 0, -1e-3), z}},
                                                     9.0);
    EXPECT_NEAR(reports[0].irradiance[0], 0.138531605994892997, element_tolerance);
    EXPECT_NEAR(reports[1].irradiance[0], 0.138531605994892997, 2 * element_tolerance);
    EXPECT_GT(reports[2].irradiance[0], 0.13);
    EXPECT_EQ(reports[3].irradiance[0], 0.0);  // under the floor
}

TEST(SensorGather, UnderARugListedLaterSeesAsTheRug) {
    Scene scene = lit_by(rectangle(z, y, x));
    add(scene, rectangle(Vec3(-1, -1, 0), 3.0 * x, 3.0 * y));
    add(scene, rectangle(Vec3(-0.5, -0.5, 0), x, y));
    EXPECT_NEAR(gather(scene, {{Vec3::Zero(), z}}, 9.0)[0].irradiance[0], 0.138531605994892997,
                element_tolerance);
}

TEST(SensorGather, KeepsTheFirstSensorsWhenItIsStopped) {
    Scene scene = lit_by(rectangle(z, y, x));
    for (int k = 0; k < 1000; ++k) scene.sensors.push_back({"", Vec3::Zero(), z});
    const CutScene lit = cut(scene, 9.0);
    const RayScene rays(lit.scene, lit.lines.overlaps);
    const std::vector<Rgb> radiosity(lit.mesh.size(), Rgb::Ones());
    int asked = 0;
    const std::vector<SensorReport> reports =
        gather_at_sensors(lit.scene, lit.mesh, rays, radiosity, 1, [&](double fraction) {
            EXPECT_LT(fraction, 1.0);
            return ++asked < 2;
        });
    EXPECT_EQ(asked, 2);
    EXPECT_LT(reports.size(), scene.sensors.size());
    ASSERT_FALSE(reports.empty());
    EXPECT_NEAR(reports.back().irradiance[0], 0.138531605994892997, element_tolerance);
}

TEST(SensorGather, AWallBetweenHidesAll) {
    Scene scene = lit_by(rectangle(z, y, x));
    add(scene, rectangle(Vec3(-3, -3, 0.5), 7.0 * x, 7.0 * y));
    EXPECT_EQ(gather(scene, {{Vec3::Zero(), z}}, 0.5)[0].irradiance[0], 0.0);
}

TEST(SensorGather, CoveredLightsDoNotShine) {
    const Polygon light = rectangle(z, y, x);
    Scene scene = lit_by(light);
    add(scene, light);  // black, and listed later
    EXPECT_EQ(gather(scene, {{Vec3::Zero(), z}}, 0.5)[0].irradiance[0], 0.0);
}

TEST(SensorGather, DoesNotDependOnScaleOrPlace) {
    for (const Motion& motion : {Motion{1e-4}, Motion{1e6, Vec3(1e9, 0, 0), odd_turn()}}) {
        const Scene scene = moved(lit_by({{0, 1, 1}, {1, 1, 1}, {1, 0, 1}, {0, 0, 1}}), motion);
        const SensorReport report =
            gather(scene, {{motion(Vec3::Zero()), motion.turn * z}}, motion.scale)[0];
        EXPECT_NEAR(report.irradiance[0], 0.138531605994892997, element_tolerance);
    }
}

}  // namespace
}  // namespace patchlight::sensor_gather_test
