#include "solver/solve_scene.h"
#include "solver/view_factors.h"
#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace patchlight::stopping_test {
namespace {

/// Stops the work at the `limit`th word from the stage, and counts what is said after that.
struct Stopper {
    Stage stage;
    int limit;
    int words = 0, after = 0;
    Verdict operator()(const Progress& progress) {
        if (words >= limit) ++after;
        if (progress.stage == stage && words < limit) ++words;
        return words >= limit ? Verdict::stop : Verdict::go_on;
    }
};

SolveSettings settings(double patch_size) {
    SolveSettings result;
    result.patch_size = patch_size;
    return result;
}

TEST(Stopping, EndsViewFactorsWithinAnObjectOfManyPatches) {
    const Scene scene = scene_of(
        {rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), rectangle({0, 0, 1}, {0, 1, 0}, {1, 0, 0})});
    Stopper stopper{Stage::display, 3};
    const ViewFactorSolver solver(scene, settings(0.1), Grouping::object);
    int rows = 0;
    const ViewFactorReport report =
        solver.find([&](const GroupFactors&) { ++rows; }, std::ref(stopper));
    EXPECT_EQ(report.status, Status::cancelled);
    EXPECT_EQ(stopper.words, 3);
    EXPECT_EQ(stopper.after, 0);
    EXPECT_EQ(rows, 0);  // the first object was not complete
}

TEST(Stopping, EndsFormFactorsBeforeThereIsOne) {
    Scene scene = room_with_box();
    scene.materials[white].exitance = Rgb::Ones();
    for (const Method method : {Method::gauss_seidel, Method::shooting}) {
        SolveSettings asked = settings(0.05);
        asked.method = method;
        Stopper stopper{Stage::form_factors, 1};
        const Solution solution = solve_scene(scene, asked, std::ref(stopper));
        EXPECT_EQ(solution.status, Status::cancelled);
        EXPECT_LE(stopper.after, 2);  // no stage begins another
        EXPECT_FALSE(solution.display.positions.empty());
    }
}

Scene with_sensors(int count) {
    Scene scene = room_with_box();
    scene.materials[white].exitance = Rgb::Ones();
    for (int k = 0; k < count; ++k)
        scene.sensors.push_back({"", Vec3(0.9, 0.9, 0.5), Vec3::UnitZ()});
    return scene;
}

TEST(Stopping, TellsOfSensorsAndLeavesThemOut) {
    Stopper stopper{Stage::display, 1};
    const Scene scene = with_sensors(300);
    const Solution solution = solve_scene(scene, settings(0.1), std::ref(stopper));
    const bool is_whole = solution.sensors.size() == scene.sensors.size();  // time was left
    EXPECT_TRUE(is_whole || solution.status == Status::cancelled);
    EXPECT_GE(stopper.words, 1);
}

TEST(Stopping, LeavesTimeForAFewSensors) {
    Stopper stopper{Stage::form_factors, 1};
    const Solution solution = solve_scene(with_sensors(3), settings(0.3), std::ref(stopper));
    EXPECT_EQ(solution.status, Status::cancelled);
    EXPECT_EQ(solution.sensors.size(), 3u);
}

}  // namespace
}  // namespace patchlight::stopping_test
