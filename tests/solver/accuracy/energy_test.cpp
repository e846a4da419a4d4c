#include "solver/accuracy/energy.h"

#include "tests/solver/form_factors/matrices.h"
#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

namespace patchlight::energy_test {
namespace {

constexpr double rounding = 1e-12;

/// A lamp of 2 m² that gives off (1, 2, 0) and a grey wall of 1 m², ρ = (0.5, 0.25, 0.5).
Scene lamp_and_wall() {
    Scene scene = empty_scene();
    scene.materials[lamp].exitance = Rgb(1, 2, 0);
    scene.materials[white].reflectance = Rgb(0.5, 0.25, 0.5);
    add(scene, flat({{0, 0}, {2, 0}, {2, 1}, {0, 1}}), lamp);
    add(scene, flat({{5, 0}, {6, 0}, {6, 1}, {5, 1}}));
    return scene;
}

/// Of the lamp's light 0.2 falls on the wall, 0.3 on backs, 0.5 escapes; of the wall's 0.4 falls on
/// the lamp and 0.6 escapes.
struct ByHand {
    CutScene cut = patchlight::cut(lamp_and_wall(), 9.0);
    ExchangeMatrix exchange = empty_matrix({2.0, 1.0});
    std::vector<Rgb> radiosity, irradiance;

    ByHand() {
        exchange.backs = {0.3, 0.0};
        exchange.escaped = {0.5, 0.6};
        // H_wall = 0.4 E, B_wall = ρ H_wall, H_lamp = 0.2 B_wall
        const Rgb on_wall = 0.4 * Rgb(1, 2, 0);
        const Rgb wall = Rgb(0.5, 0.25, 0.5) * on_wall;
        radiosity = {Rgb(1, 2, 0), wall};
        irradiance = {0.2 * wall, on_wall};
    }
};

TEST(MeasureEnergy, TellsWhereTheLightWent) {
    const ByHand scene;
    const EnergyReport energy = measure_energy(scene.cut.scene, scene.cut.mesh, scene.exchange,
                                               scene.radiosity, scene.irradiance);
    const Rgb wall(0.2, 0.2, 0.0);  // radiosity of the wall
    const auto expect_equal = [](const Rgb& a, const Rgb& b) {
        EXPECT_LT((a - b).abs().maxCoeff(), rounding) << a.transpose() << " for " << b.transpose();
    };
    expect_equal(energy.emitted, Rgb(2, 4, 0));
    expect_equal(energy.absorbed, Rgb(0.2 * 1 + 0.04 * 2, 0.6 * 1 + 0.04 * 2, 0));
    expect_equal(energy.backs, 0.3 * 2 * Rgb(1, 2, 0));
    expect_equal(energy.escaped, 0.5 * 2 * Rgb(1, 2, 0) + 0.6 * wall);
}

TEST(MeasureEnergy, OfAConsistentSolutionLacksNothing) {
    const ByHand scene;
    EXPECT_LT(measure_energy(scene.cut.scene, scene.cut.mesh, scene.exchange, scene.radiosity,
                             scene.irradiance)
                  .defect,
              rounding);
}

TEST(MeasureEnergy, TheDefectIsThatOfTheWorstChannelThatShines) {
    ByHand scene;
    scene.exchange.escaped[0] = 0.4;  // a tenth of the lamp's light is lost track of
    scene.radiosity[1][2] = 7.0;      // blue out of nothing does not count
    EXPECT_NEAR(measure_energy(scene.cut.scene, scene.cut.mesh, scene.exchange, scene.radiosity,
                               scene.irradiance)
                    .defect,
                0.1, rounding);
}

TEST(MeasureObjects, GivesAreaMeansAndTheRangeOfTheField) {
    Scene scene = empty_scene();
    scene.objects.push_back({"both"});
    add_polygon(scene, 0, white, 0, flat({{0, 0}, {2, 0}, {2, 1}, {0, 1}}), "");
    add_polygon(scene, 0, lamp, 1, flat({{5, 0}, {6, 0}, {6, 1}, {5, 1}}), "");
    scene.objects.push_back({"empty"});
    Solution solution;
    solution.mesh = cut(scene, 9.0).mesh;
    solution.radiosity = {Rgb(1, 1, 1), Rgb(4, 7, 10)};
    solution.irradiance = {Rgb(3, 3, 3), Rgb(0, 0, 0)};
    solution.display.radiosity = {Rgb(0.5, 2, 1), Rgb(1, 1, 1), Rgb(9, 0, 1)};
    solution.display.triangles = {{0, 1, 2}};
    solution.display.patch = {0};
    const std::vector<ObjectReport> objects = measure_objects(scene, solution);
    ASSERT_EQ(objects.size(), 2u);
    EXPECT_NEAR(objects[0].area, 3.0, rounding);
    EXPECT_LT((objects[0].radiosity - Rgb(2, 3, 4)).abs().maxCoeff(), rounding);
    EXPECT_LT((objects[0].irradiance - Rgb(2, 2, 2)).abs().maxCoeff(), rounding);
    EXPECT_LT((objects[0].emitted - Rgb(1, 1, 1)).abs().maxCoeff(), rounding);
    EXPECT_TRUE((objects[0].min == Rgb(0.5, 0, 1)).all());
    EXPECT_TRUE((objects[0].max == Rgb(9, 2, 1)).all());
    EXPECT_EQ(objects[1].area, 0.0);
    EXPECT_TRUE(objects[1].min.isFinite().all());
}

}  // namespace
}  // namespace patchlight::energy_test
