#include "tests/solver/scenes.h"
#include "tests/solver/view_factor_table.h"

#include <gtest/gtest.h>

#include <vector>

namespace patchlight::view_factors_stop_test {
namespace {

SolveSettings quick() {
    SolveSettings settings;
    settings.patch_size = 0.34;
    settings.rays = 64;
    return settings;
}

std::size_t told(const ViewFactorTable& table) {
    std::size_t rows = 0;
    for (std::size_t i = 0; i < table.size(); ++i) rows += table.row_sum(i) > 0.0;
    return rows;
}

TEST(ViewFactorsProgress, RunsUpToOneInEachStage) {
    std::vector<Progress> steps;
    const ViewFactorTable table =
        view_factors(room_with_box(), quick(), Grouping::object, [&](const Progress& progress) {
            steps.push_back(progress);
            return Verdict::go_on;
        });
    EXPECT_EQ(table.report.status, Status::converged);
    ASSERT_FALSE(steps.empty());
    for (std::size_t k = 1; k < steps.size(); ++k)
        if (steps[k].stage == steps[k - 1].stage)
            EXPECT_GE(steps[k].fraction, steps[k - 1].fraction);
        else
            EXPECT_NEAR(steps[k - 1].fraction, 1.0, 1e-9);
    EXPECT_NEAR(steps.back().fraction, 1.0, 1e-9);
}

TEST(ViewFactorsProgress, StopsBeforeThereAreRows) {
    const ViewFactorTable table = view_factors(room_with_box(), quick(), Grouping::object,
                                               [](const Progress&) { return Verdict::stop; });
    EXPECT_EQ(table.report.status, Status::cancelled);
    EXPECT_EQ(told(table), 0u);
}

TEST(ViewFactorsProgress, StopsAmongTheRows) {
    const ViewFactorTable table =
        view_factors(room_with_box(), quick(), Grouping::object, [](const Progress& progress) {
            return progress.stage == Stage::display ? Verdict::stop : Verdict::go_on;
        });
    EXPECT_EQ(table.report.status, Status::cancelled);
    EXPECT_EQ(told(table), 0u);
}

TEST(ViewFactorsProgress, StopsStreamedRowsToo) {
    const SolveSettings settings = with_little_memory(room(), 0.045);
    const ViewFactorTable table =
        view_factors(room(), settings, Grouping::object, [](const Progress& progress) {
            return progress.fraction > 0.0 ? Verdict::stop : Verdict::go_on;
        });
    EXPECT_TRUE(table.report.streamed);
    EXPECT_EQ(table.report.status, Status::cancelled);
    EXPECT_EQ(told(table), 0u);
}

TEST(ViewFactorsProgress, StopsInTheMiddleOfALargeObject) {
    Scene scene = room();
    for (Surface& surface : scene.surfaces) surface.object = 0;
    scene.objects.resize(1);
    double reached = 0.0;
    const ViewFactorTable table = view_factors(
        scene, with_little_memory(scene, 0.045), Grouping::object, [&](const Progress& progress) {
            reached = progress.fraction;
            return reached > 0.2 ? Verdict::stop : Verdict::go_on;
        });
    EXPECT_TRUE(table.report.streamed);
    EXPECT_EQ(table.report.status, Status::cancelled);
    EXPECT_LT(reached, 0.5);
}

TEST(ViewFactorsProgress, EndsAtTheTimeLimit) {
    SolveSettings settings = quick();
    settings.time_limit = 1e-9;
    const ViewFactorTable table = view_factors(room_with_box(), settings, Grouping::object);
    EXPECT_EQ(table.report.status, Status::limit);
    EXPECT_EQ(told(table), 0u);
}

TEST(ViewFactorsProgress, TimeIsUpWhileTheMeshIsCut) {
    SolveSettings settings = quick();
    settings.patch_size = 0.002;
    settings.time_limit = 1e-9;
    const Scene scene = room_with_box();
    const ViewFactorSolver solver(scene, settings, Grouping::object);
    const ViewFactorReport report =
        solver.find([](const GroupFactors&) { FAIL() << "no factors without a mesh"; }, {});
    EXPECT_EQ(report.status, Status::limit);
    EXPECT_LT(report.patches, 100u) << "polygons as they are given";
}

}  // namespace
}  // namespace patchlight::view_factors_stop_test
