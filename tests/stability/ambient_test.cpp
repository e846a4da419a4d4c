#include "tests/stability/judgement.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace patchlight::stability::ambient_test {
namespace {

/// The ambient term is shooting's alone.
std::vector<Column> shooting_columns() {
    std::vector<Column> columns;
    for (const Column& column : every_column())
        if (column.shoots()) columns.push_back(column);
    return columns;
}

class Ambient : public EveryColumn {};

/// Area mean of the field that pictures show.
double shown_mean(const DisplayMesh& display) {
    double light = 0.0, area = 0.0;
    for (const auto& t : display.triangles) {
        const Vec3& p = display.positions[t[0]];
        const double a =
            0.5 * (display.positions[t[1]] - p).cross(display.positions[t[2]] - p).norm();
        area += a;
        for (const std::uint32_t v : t) light += a / 3.0 * display.radiosity[v][0];
    }
    return light / area;
}

TEST_P(Ambient, DoesNotCountLightThatLeavesAnOpenRoom) {
    SolveSettings settings = settings_for(GetParam(), {0.2, 256, 1e-3});
    settings.ambient = true;
    std::vector<double> means;
    const Solution solution =
        solve_scene(cornell_like(true), settings, [&](const Progress& progress) {
            if (progress.picture && progress.iteration < 64)
                means.push_back(shown_mean((*progress.picture)()));
            return Verdict::go_on;
        });
    ASSERT_GT(means.size(), 4u);
    const double last = shown_mean(solution.display);
    double worst = 0.0;
    for (const double mean : means) worst = std::max(worst, mean / last - 1.0);
    constexpr double few_percent = 0.03;  // of uneven surroundings; uncounted escapes: +40 %
    judge("B7", GetParam(), worst, few_percent);
}

TEST_P(Ambient, StaysRightWhereAlmostNothingIsAbsorbed) {
    constexpr double reflectance = 0.9999;
    SceneBuilder builder;
    builder.box("room", builder.material(reflectance, 1.0), {0, 0, 0}, {1, 1, 1}, true);
    SolveSettings settings = settings_for(GetParam(), {0.5, 256, 1e-3});
    settings.ambient = true;
    settings.max_iterations = 8;
    const Solution solution = patchlight::solve(builder.scene, settings);
    EXPECT_EQ(solution.status, Status::limit);
    constexpr double rounding = 1e-6;
    judge("B8", GetParam(), std::abs(shown_mean(solution.display) * (1.0 - reflectance) - 1.0),
          rounding);
}

INSTANTIATE_TEST_SUITE_P(Each, Ambient, testing::ValuesIn(shooting_columns()), column_name);

}  // namespace
}  // namespace patchlight::stability::ambient_test
