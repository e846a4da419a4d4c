#include "server/exposure.h"

#include "tests/server/small_solution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace patchlight::server::exposure_test {
namespace {

constexpr double rounding = 1e-12;  // [stops]

TEST(Exposure, BringsReflectedLightToMiddleGrey) {
    Solution solution = small_solution();
    solution.radiosity = {Rgb(100, 100, 100), Rgb(10, 10, 10)};  // the lamp reflects nothing
    const double radiance = 10 / std::numbers::pi;
    EXPECT_NEAR(automatic_exposure(small_job().scene, solution), std::log2(0.3 / radiance),
                rounding);
}

TEST(Exposure, WeighsByAreaAndBrightness) {
    Solution solution = small_solution();
    solution.radiosity = {Rgb(101, 101, 101), Rgb(4, 4, 4)};  // 2 m² at 1, 1 m² at 4
    const double typical = (2 * 1 + 1 * 16) / (2 * 1 + 1 * 4.0) / std::numbers::pi;
    EXPECT_NEAR(automatic_exposure(small_job().scene, solution), std::log2(0.3 / typical),
                rounding);
}

TEST(Exposure, CoveredPatchesDoNotCount) {
    Solution solution = small_solution();
    solution.radiosity = {Rgb(101, 101, 101), Rgb(4, 4, 4)};
    solution.mesh.patches[1].covered = true;
    EXPECT_NEAR(automatic_exposure(small_job().scene, solution), std::log2(0.3 * std::numbers::pi),
                rounding);
}

TEST(Exposure, IsZeroWhereNothingReflects) {
    Solution solution = small_solution();
    solution.radiosity = {Rgb(100, 100, 100), Rgb(0, 0, 0)};
    EXPECT_EQ(automatic_exposure(small_job().scene, solution), 0.0);
}

}  // namespace
}  // namespace patchlight::server::exposure_test
