#include "solver/form_factors/point_factor.h"
#include "tests/physics/random_room.h"
#include "tests/physics/rooms.h"

#include <Eigen/Geometry>

#include <cmath>
#include <random>

namespace patchlight::accuracy_test {
namespace {

SolveSettings to(double accuracy) {
    SolveSettings settings;
    settings.accuracy = accuracy;
    return settings;
}

/// Relative error of the displayed field where the exact radiosity is one value on each object.
double error_of(const Scene& scene, const Solution& solution,
                const std::function<double(ObjectIndex)>& exact) {
    double wrong = 0.0, whole = 0.0;
    for (std::size_t t = 0; t < solution.display.triangles.size(); ++t) {
        const auto& [a, b, c] = solution.display.triangles[t];
        const auto& p = solution.display.positions;
        const double area = 0.5 * (p[b] - p[a]).cross(p[c] - p[a]).norm();
        const PatchIndex i = solution.display.patch[t];
        const ObjectIndex object = scene_object(scene, solution, i);
        const double exitance = luminance(
            scene.materials[scene.surfaces[solution.mesh.patches[i].surface].material].exitance);
        for (const std::uint32_t v : {a, b, c}) {
            const double miss = luminance(solution.display.radiosity[v]) - exact(object);
            wrong += area / 3.0 * miss * miss;
            whole += area / 3.0 * std::pow(exact(object) - exitance, 2);
        }
    }
    return std::sqrt(wrong / whole);
}

TEST(Accuracy, AFurnaceIsAsWrongAsItSays) {
    for (const double reflectance : {0.5, 0.9}) {
        SceneBuilder builder;
        builder.box("room", builder.material(reflectance, 1.0), Vec3::Zero(), Vec3(2, 3, 2.5),
                    true);
        const double exact = 1.0 / (1.0 - reflectance);
        for (const double accuracy : {0.1, 0.03, 0.01}) {
            const Solution solution = solve(builder.scene, to(accuracy));
            EXPECT_EQ(solution.status, Status::converged);
            ASSERT_TRUE(solution.error.estimate);
            const double error =
                error_of(builder.scene, solution, [&](ObjectIndex) { return exact; });
            EXPECT_LE(error, accuracy);
            EXPECT_LE(error, *solution.error.estimate + 1e-4);
        }
    }
}

TEST(Accuracy, BeginsAndEndsWithWhatWasAsked) {
    for (const bool open : {false, true}) {
        const Scene scene = cornell_like(open);
        for (const double accuracy : {0.1, 0.02}) {
            const Solution solution = solve(scene, to(accuracy));
            EXPECT_EQ(solution.status, Status::converged);
            EXPECT_EQ(solution.error.target, accuracy);
            EXPECT_TRUE(solution.error.met());
            EXPECT_LE(*solution.error.estimate, accuracy);
            EXPECT_GE(*solution.error.estimate,
                      *solution.error.algebraic_bound +
                          std::hypot(*solution.error.mesh, *solution.error.form_factors) - 1e-12);
            EXPECT_LT(solution.energy.defect, accuracy);
        }
    }
}

/// ∫ Y(B - E)² dA over what is displayed [W²/m²]. Most of it may be a bright spot beside a lamp.
double displayed_square(const Scene& scene, const Solution& solution) {
    const DisplayMesh& display = solution.display;
    double sum = 0.0;
    for (std::size_t t = 0; t < display.triangles.size(); ++t) {
        const auto [a, b, c] = display.triangles[t];
        const Patch& patch = solution.mesh.patches[display.patch[t]];
        const Rgb exitance = scene.materials[scene.surfaces[patch.surface].material].exitance;
        const auto square = [&](std::uint32_t k, std::uint32_t l) {  // at the middle of an edge
            return std::pow(
                luminance(0.5 * (display.radiosity[k] + display.radiosity[l]) - exitance), 2);
        };
        const auto& p = display.positions;
        sum += 0.5 * (p[b] - p[a]).cross(p[c] - p[a]).norm() *
               (square(a, b) + square(b, c) + square(c, a)) / 3.0;
    }
    return sum;
}

TEST(Accuracy, TighterSolvesAgreeWithinBothEstimates) {
    // Two independent solves of a room: object means may differ by no more than both estimates.
    for (const unsigned seed : {7u, 8u, 9u}) {
        const Scene scene = random_room(seed);
        const Solution fine = solve(scene, to(0.01));
        SolveSettings settings = to(0.04);
        settings.seed = 99;
        const Solution rough = solve(scene, settings);
        double wrong = 0.0;
        for (std::size_t o = 0; o < scene.objects.size(); ++o) {
            const double a = luminance(fine.objects[o].radiosity),
                         b = luminance(rough.objects[o].radiosity);
            wrong += fine.objects[o].area * (a - b) * (a - b);
        }
        EXPECT_LE(std::sqrt(wrong / displayed_square(scene, fine)),
                  *fine.error.estimate + *rough.error.estimate)
            << seed;
    }
}

TEST(Accuracy, IsTheSameFromAnyNumberOfThreads) {
    SolveSettings settings = to(0.05);
    settings.threads = 1;
    const Solution one = solve(cornell_like(), settings);
    settings.threads = 2;
    const Solution two = solve(cornell_like(), settings);
    ASSERT_EQ(one.display.radiosity.size(), two.display.radiosity.size());
    for (std::size_t v = 0; v < one.display.radiosity.size(); ++v)
        EXPECT_TRUE((one.display.radiosity[v] == two.display.radiosity[v]).all()) << v;
    EXPECT_EQ(one.error.estimate, two.error.estimate);
}

TEST(Accuracy, SensorsSayHowWrongTheyAre) {
    // A furnace: irradiance is E / (1 - rho) wherever a sensor looks.
    SceneBuilder builder;
    builder.box("room", builder.material(0.5, 1.0), Vec3::Zero(), Vec3(2, 2, 2), true);
    builder.sensor({1, 1, 1}, Vec3::UnitZ());
    builder.sensor({0.2, 0.3, 0.5}, Vec3(1, 2, 3).normalized());
    const Solution solution = solve(builder.scene, to(0.02));
    for (const SensorReport& sensor : solution.sensors)
        EXPECT_NEAR(luminance(sensor.irradiance), 2.0, 3.0 * sensor.error + 0.002);
}

/// Of sensors all over three rooms, the same in two independent solves.
TEST(Accuracy, SensorsAgreeWithinTwoErrors) {
    int within = 0, all = 0;
    for (const unsigned seed : {11u, 12u, 13u}) {
        Scene scene = random_room(seed);
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> share(0.1, 0.9);
        Vec3 size = Vec3::Zero();
        for (const Surface& surface : scene.surfaces)
            for (const Vec3& corner : surface.corners) size = size.cwiseMax(corner);
        for (int k = 0; k < 40; ++k)
            scene.sensors.push_back(
                {"", Vec3(share(random), share(random), share(random)).cwiseProduct(size),
                 Vec3(share(random) - 0.5, share(random) - 0.5, share(random) - 0.5).normalized()});
        const Solution fine = solve(scene, to(0.02));
        SolveSettings settings = to(0.1);
        settings.seed = 99;
        const Solution rough = solve(scene, settings);
        for (std::size_t k = 0; k < scene.sensors.size(); ++k) {
            const SensorReport &a = fine.sensors[k], &b = rough.sensors[k];
            const double apart = std::abs(luminance(a.irradiance - b.irradiance));
            within += apart <= 2.0 * std::hypot(a.error, b.error);
            ++all;
        }
    }
    EXPECT_GE(within, 0.9 * all);  // 95 % are: fewer than 108 of 120 by chance in 2 runs of 100
}

/// Two rooms as two boxes whose floors and ceilings lie in one plane and meet below one wall.
TEST(Accuracy, NoLightCrossesAWallWithoutThickness) {
    SceneBuilder builder;
    const MaterialIndex paint = builder.material(0.6, 0.0), lit = builder.material(0.5, 100.0);
    builder.box("first", paint, Vec3::Zero(), Vec3(4, 3, 2.5), true);
    builder.box("second", paint, Vec3(4, 0, 0), Vec3(8, 3, 2.5), true);
    builder.polygon("lamp", lit, {{1, 2, 2.5}, {3, 2, 2.5}, {3, 1, 2.5}, {1, 1, 2.5}});
    for (const double accuracy : {0.1, 0.02}) {
        const Solution solution = solve(builder.scene, to(accuracy));
        EXPECT_TRUE(solution.error.met());
        EXPECT_GT(solution.objects[0].irradiance[0], 1.0);
        EXPECT_EQ(solution.objects[1].max[0], 0.0);
        EXPECT_EQ(solution.objects[1].irradiance[0], 0.0);
    }
}

TEST(Accuracy, NeedlesThatCoverOneAnotherStayFinite) {
    SceneBuilder builder;
    const MaterialIndex stone = builder.material(0.6, 0.0), sky = builder.material(0.0, 90.0);
    builder.polygon("sky", sky, {{-4, 3, -4}, {4, 3, -4}, {4, 3, 4}, {-4, 3, 4}});
    const double y = 0.510791;
    builder.polygon(
        "a", stone,
        {{0.325043, y, 0.146922}, {0.325042, y, -0.136933}, {0.325043, 0.497996, 0.146922}});
    builder.polygon("b", stone,
                    {{0.325043, y, 0.146922}, {0.345973, y, 0.146922}, {0.325042, y, -0.136933}});
    builder.polygon("c", stone,
                    {{0.12884, y, -0.327221}, {0.329556, y, -0.126505}, {0.14364, y, -0.342021}});
    builder.polygon(
        "d", stone,
        {{0.329556, y, -0.126505}, {0.12884, y, -0.327221}, {0.329556, 0.497996, -0.126505}});
    builder.polygon("e", stone,
                    {{-0.124156, 0.545685, -0.352377},
                     {-0.152924, 0.545685, -0.343206},
                     {-0.115046, 0.545685, -0.323801}});
    const Solution solution = solve(builder.scene, to(0.02));
    for (const Rgb& radiosity : solution.display.radiosity) EXPECT_TRUE(radiosity.allFinite());
}

TEST(Accuracy, ALampThatLightsNothingCostsNothing) {
    SceneBuilder builder;  // tilted: rounding leaves 1e-17 of it on itself
    builder.polygon("lamp", builder.material(0.0, 1.0),
                    {{0.2, 0.6, 2.1}, {-0.7, 0.9, 0.5}, {1.2, -0.4, 0.3}});
    const Solution solution = solve(builder.scene, to(0.01));
    EXPECT_EQ(solution.status, Status::converged);
    EXPECT_LT(solution.display.triangles.size(), 5000u);
}

/// All that is lit is a spot narrower than a patch: 4 cm above a lamp that faces the ceiling.
TEST(Accuracy, TheSpotAboveALowLampIsFound) {
    SceneBuilder builder;
    const MaterialIndex black = builder.material(0.0, 0.0), white = builder.material(0.5, 0.0);
    constexpr double top = 2.7, width = 5.0;
    builder.box("room", black, Vec3::Zero(), Vec3(width, width, top), true);
    constexpr std::size_t ceiling = 1;
    builder.scene.surfaces[ceiling].material = white;
    ConvexPolygon lamp;
    for (const Vec3& p : {Vec3(1.31, 2.22, top - 0.04), Vec3(1.52, 2.22, top - 0.04),
                          Vec3(1.52, 2.35, top - 0.04), Vec3(1.31, 2.35, top - 0.04)})
        lamp.add(p);
    builder.polygon("lamp", builder.material(0.0, 10.0),
                    std::vector<Vec3>(lamp.view().begin(), lamp.view().end()));
    for (const double accuracy : {0.1, 0.02}) {
        const Solution solution = solve(builder.scene, to(accuracy));
        const DisplayMesh& display = solution.display;
        double wrong = 0.0, whole = 0.0;
        for (std::size_t t = 0; t < display.triangles.size(); ++t) {
            if (solution.mesh.patches[display.patch[t]].surface != ceiling) continue;
            const auto& [a, b, c] = display.triangles[t];
            const Vec3 &p = display.positions[a], u = display.positions[b] - p,
                       v = display.positions[c] - p;
            const int n = 1 + static_cast<int>(std::max(u.norm(), v.norm()) / 0.02);
            for (int k = 0; k < n * n; ++k) {
                double i = (k % n + 0.5) / n, j = (k / n + 0.5) / n;
                if (i + j > 1.0) i = 1.0 - i, j = 1.0 - j;
                const double exact =
                    0.5 * 10.0 *
                    point_factor(p + i * u + j * v, -Vec3::UnitZ(), lamp, Vec3::UnitZ());
                const auto& shown = display.radiosity;
                const double found =
                    (1.0 - i - j) * shown[a][0] + i * shown[b][0] + j * shown[c][0];
                const double share = 0.5 * u.cross(v).norm() / (n * n);
                wrong += share * std::pow(found - exact, 2);
                whole += share * std::pow(exact, 2);
            }
        }
        ASSERT_TRUE(solution.error.estimate);
        EXPECT_LE(std::sqrt(wrong / whole), *solution.error.estimate);
        EXPECT_LE(std::sqrt(wrong / whole), accuracy);
    }
}

TEST(Accuracy, AMissedTargetShows) {
    SolveSettings settings = to(0.0005);
    settings.time_limit = 0.3;
    const Solution solution = solve(cornell_like(), settings);
    EXPECT_EQ(solution.status, Status::limit);
    EXPECT_FALSE(solution.error.met());
    EXPECT_FALSE(solution.display.triangles.empty());
}

TEST(Accuracy, NothingThatReflectsLeavesTheSensors) {
    SceneBuilder builder;
    const MaterialIndex black = builder.material(0.0, 0.0), lit = builder.material(0.0, 1.0);
    builder.polygon("lamp", lit, {{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}});
    builder.polygon("floor", black, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    EXPECT_FALSE(solve(builder.scene, to(0.01)).error.estimate);
    builder.sensor({0.5, 0.5, 0}, Vec3::UnitZ());
    const Solution solution = solve(builder.scene, to(0.01));
    EXPECT_EQ(solution.status, Status::converged);
    ASSERT_TRUE(solution.error.estimate);
    EXPECT_LE(*solution.error.estimate, 1e-6) << "nothing blocks, so nothing is left to chance";
}

/// The estimate of what is set by hand against a far better solve.
TEST_P(EveryEngineAndMethod, SaysHowWrongAHandSetSolveIs) {
    const Scene scene = cornell_like();
    SolveSettings settings = settings_of(GetParam());
    settings.patch_size = 0.25;
    set_rays(settings, 128);
    const Solution found = solve(scene, settings);
    ASSERT_TRUE(found.error.estimate && found.error.mesh && found.error.form_factors);
    EXPECT_FALSE(found.error.target);
    static const Solution best = solve(scene, to(0.005));
    double wrong = 0.0, whole = 0.0;  // of object means: a part of the error
    for (std::size_t o = 0; o < scene.objects.size(); ++o) {
        const double emitted = luminance(best.objects[o].emitted) / best.objects[o].area;
        const double a = luminance(best.objects[o].radiosity),
                     b = luminance(found.objects[o].radiosity);
        wrong += best.objects[o].area * (a - b) * (a - b);
        whole += best.objects[o].area * (a - emitted) * (a - emitted);
    }
    EXPECT_GE(*found.error.estimate, std::sqrt(wrong / whole));
    EXPECT_LT(*found.error.estimate, 0.6);
}

INSTANTIATE_TEST_SUITE_P(EveryWay, EveryEngineAndMethod, testing::ValuesIn(every_way()), way_name);

}  // namespace
}  // namespace patchlight::accuracy_test
