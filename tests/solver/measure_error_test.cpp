#include "solver/solve_scene.h"
#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

namespace patchlight::measure_error_test {
namespace {

TEST(MeasureError, WithoutItASolveShowsTheSameAndSaysNothingOfItsError) {
    Scene scene = room_with_box();
    scene.materials[white].exitance = Rgb::Constant(1.0);
    for (const Engine engine : {Engine::analytic, Engine::hemicube}) {
        SolveSettings settings;
        settings.engine = engine;
        settings.patch_size = 0.5;
        const Solution measured = solve_scene(scene, settings, {});
        settings.measure_error = false;
        const Solution plain = solve_scene(scene, settings, {});
        EXPECT_TRUE(measured.error.estimate);
        EXPECT_GT(measured.seconds.measuring, 0.0);
        EXPECT_LE(measured.seconds.measuring,
                  measured.seconds.form_factors + measured.seconds.display);
        EXPECT_FALSE(plain.error.estimate);
        EXPECT_FALSE(plain.form_factors.hemicube);
        ASSERT_EQ(plain.display.radiosity.size(), measured.display.radiosity.size());
        for (std::size_t v = 0; v < plain.display.radiosity.size(); ++v)
            EXPECT_TRUE((plain.display.radiosity[v] == measured.display.radiosity[v]).all());
    }
}

}  // namespace
}  // namespace patchlight::measure_error_test
