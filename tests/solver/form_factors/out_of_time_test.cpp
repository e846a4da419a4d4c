#include "solver/form_factors/analytic_engine.h"
#include "solver/form_factors/hemicube_errors.h"
#include "solver/form_factors/ray_cast_engine.h"
#include "solver/transport/row_source.h"
#include "solver/transport/shooting.h"
#include "tests/solver/form_factors/engine_scene.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>

namespace patchlight::out_of_time_test {
namespace {

/// A clock that runs out after so many looks.
struct Looks {
    explicit Looks(int most) : left(most) {}
    std::atomic<int> left;
    std::function<bool()> in_time() {
        return [this] { return left-- > 0; };
    }
};

/// Every engine, with rows that take seconds each.
std::vector<std::unique_ptr<FormFactorEngine>> slow_engines(const EngineScene& of) {
    HemicubeSettings fine;
    fine.resolution = 2048;
    AnalyticSettings many;
    many.rays = 1 << 24;
    std::vector<std::unique_ptr<FormFactorEngine>> engines;
    engines.push_back(std::make_unique<HemicubeEngine>(of.cut.scene, of.cut.mesh, of.rays, fine));
    engines.push_back(
        std::make_unique<RayCastEngine>(of.cut.scene, of.cut.mesh, of.rays, 1 << 24, 1));
    engines.push_back(std::make_unique<AnalyticEngine>(of.cut.scene, of.cut.mesh, of.rays, many));
    return engines;
}

TEST(OutOfTime, EndsWithinARow) {
    const EngineScene closed(room_with_box(), 0.1);
    const PatchIndex patch = closed.cut.mesh.first_of_surface[1];
    for (const auto& engine : slow_engines(closed)) {
        Looks two(2);
        engine->give_up_unless(two.in_time());
        FactorRow row;
        EXPECT_THROW(engine->whole_row(patch, row), OutOfTime);
        EXPECT_EQ(two.left, -1) << "no look after the one that ended it";
        EXPECT_THROW(engine->outside(patch), OutOfTime);
    }
}

TEST(OutOfTime, AMatrixIsIncompleteAndTheObserverIsAsked) {
    const EngineScene closed(room_with_box(), 0.1);
    for (const auto& engine : slow_engines(closed)) {
        Looks two(2);
        engine->give_up_unless(two.in_time());
        int asked = 0;
        const ExchangeMatrix matrix =
            build_exchange(*engine, closed.cut.scene, closed.cut.mesh, [&](double) {
                ++asked;
                return false;
            });
        EXPECT_FALSE(matrix.complete);
        EXPECT_EQ(asked, 1);
    }
}

TEST(OutOfTime, ShootingKeepsWhatWasShotBefore) {
    const EngineScene closed(room_with_box(), 0.5);
    AnalyticEngine engine(closed.cut.scene, closed.cut.mesh, closed.rays, {});
    bool in_time = true;
    engine.give_up_unless([&] { return in_time; });
    const std::size_t n = closed.cut.mesh.size();
    RowSource rows(engine, n, 0);  // none is kept
    std::vector<double> area;
    for (const Patch& patch : closed.cut.mesh.patches) area.push_back(patch.area);
    Field exitance(1, std::vector<double>(n, 0.0)), reflectance(1, std::vector<double>(n, 0.5));
    const PatchIndex lit = closed.cut.mesh.first_of_surface[1];
    exitance[0][lit] = 1.0;
    ShootingStop stop{1e-6, 1000, {}};
    stop.observe = [&](const ShotSoFar&) {
        in_time = false;
        return StopReason::tolerance;
    };
    const ShootingReport report = shoot({rows, area, exitance, reflectance}, stop);
    EXPECT_EQ(report.stopped_by, StopReason::time_limit);
    EXPECT_EQ(report.state.shots, 1);
    double arrived = 0.0;
    for (std::size_t i = 0; i < n; ++i) arrived += area[i] * report.state.irradiance[0][i];
    EXPECT_NEAR(arrived, area[lit], 1e-5) << "a closed room: what one patch sent";
    EXPECT_NEAR(report.state.unshot_share, 0.5, 1e-5);
}

TEST(OutOfTime, HemicubesAreNotMeasured) {
    const EngineScene closed(room_with_box(), 0.5);
    HemicubeSettings settings;
    const auto at = [&](const std::function<bool()>& in_time) {
        return estimate_hemicube_errors(closed.cut.scene, closed.cut.mesh, closed.rays, settings,
                                        in_time);
    };
    EXPECT_TRUE(at([] { return true; }));
    EXPECT_FALSE(at([] { return false; }));
}

}  // namespace
}  // namespace patchlight::out_of_time_test
