#include "solver/form_factors/exchange_matrix.h"
#include "tests/physics/rooms.h"
#include "tests/slope.h"

#include <cmath>

namespace patchlight::convergence_test {

namespace {

/// Area-weighted relative difference of radiosity between two solutions on one mesh.
double difference(const Solution& a, const Solution& b) {
    double squared = 0.0, size = 0.0;
    for (PatchIndex i = 0; i < a.mesh.size(); ++i) {
        squared += a.mesh.patches[i].area * std::pow(a.radiosity[i][0] - b.radiosity[i][0], 2);
        size += a.mesh.patches[i].area * std::pow(b.radiosity[i][0], 2);
    }
    return std::sqrt(squared / size);
}

/// Slopes are judged at four standard errors of the fit, and never finer than this.
constexpr double least_band = 0.1;
double band(const Slope& slope) { return std::max(least_band, 4.0 * slope.error); }

}  // namespace

TEST(Convergence, RayCastErrorFallsAtLeastAsIndependentRaysWould) {
    const Scene scene = cornell_like();
    SolveSettings settings;
    settings.engine = Engine::ray_cast;
    settings.patch_size = 0.08;
    settings.tolerance = 1e-7;
    settings.rays = 1 << 16;
    settings.seed = 99;
    const Solution reference = solve(scene, settings);
    std::vector<double> rays, errors;
    for (int count = 64; count <= 1024; count *= 2) {
        double mean_square = 0.0;
        constexpr int seeds = 4;
        for (int seed = 1; seed <= seeds; ++seed) {
            settings.rays = count;
            settings.seed = static_cast<std::uint64_t>(seed);
            mean_square += std::pow(difference(solve(scene, settings), reference), 2) / seeds;
        }
        rays.push_back(count);
        errors.push_back(std::sqrt(mean_square));
    }
    const Slope slope = fit_slope(rays, errors);
    RecordProperty("slope", std::to_string(slope.value));
    EXPECT_LT(slope.value, -0.5 + band(slope)) << "independent rays: -1/2";
    EXPECT_GT(slope.value, -1.0 - band(slope))
        << "scrambled Sobol points in four dimensions: no better than -1";
}

TEST(Convergence, MeanRadiosityFallsAsTheSquareOfThePatchSize) {
    // An empty room: exact factors, so that patches are all that errs (order 2 for means).
    SceneBuilder builder;
    for (std::size_t f = 0; f < 1; ++f)
        builder.box("room", builder.material(0.5, 0.0), {0, 0, 0}, {1, 1, 1}, true);
    builder.scene.surfaces[0].material = builder.material(0.5, 1.0);  // the floor gives off light
    std::vector<double> sizes, errors;
    constexpr double converged = 0.171216034;  // mean of the opposite wall (s-d06)
    for (const int parts : {4, 8, 16}) {
        SolveSettings settings;
        settings.patch_size = 1.0 / parts;
        settings.tolerance = 1e-9;
        const Solution solution = solve(builder.scene, settings);
        double power = 0.0;
        for (PatchIndex i = solution.mesh.first_of_surface[1];
             i < solution.mesh.first_of_surface[2]; ++i)
            power += solution.radiosity[i][0] * solution.mesh.patches[i].area;
        sizes.push_back(*settings.patch_size);
        errors.push_back(std::abs(power - converged));
    }
    const Slope slope = fit_slope(sizes, errors);
    RecordProperty("slope", std::to_string(slope.value));
    EXPECT_NEAR(slope.value, 2.0, band(slope));
}

TEST(Convergence, RadiosityOfTheCornellBoxSettlesWithPatchSize) {
    const Scene scene = cornell_like();
    std::vector<double> sizes, errors;
    const auto means = [&](double patch_size) {
        SolveSettings settings;
        settings.patch_size = patch_size;
        settings.tolerance = 1e-7;
        return solve(scene, settings).objects;
    };
    const std::vector<ObjectReport> finest = means(0.025);
    for (const double patch_size : {0.2, 0.1, 0.05}) {
        const std::vector<ObjectReport> coarse = means(patch_size);
        double squared = 0.0;
        for (std::size_t o = 0; o < finest.size(); ++o)
            squared += std::pow(coarse[o].irradiance[0] / finest[o].irradiance[0] - 1.0, 2) /
                       static_cast<double>(finest.size());
        sizes.push_back(patch_size);
        errors.push_back(std::sqrt(squared));
    }
    const Slope slope = fit_slope(sizes, errors);
    RecordProperty("slope", std::to_string(slope.value));
    EXPECT_GT(slope.value, 1.0 - band(slope)) << "shadow edges cost piecewise constants one order";
    EXPECT_LT(slope.value, 2.5 + band(slope));
    EXPECT_LT(errors.back(), 0.02);
}

TEST(Convergence, TrueErrorFallsByTheFactorOfGaussSeidelAndStaysUnderTheBound) {
    const Scene scene = cornell_like();
    SolveSettings settings;
    settings.patch_size = 0.08;
    settings.tolerance = 1e-12;
    const Solution converged = solve(scene, settings);
    std::vector<double> errors;
    for (const int sweeps : {2, 3, 4, 5, 6}) {
        settings.tolerance = 1e-13;
        settings.max_iterations = sweeps;
        const Solution part = solve(scene, settings);
        errors.push_back(difference(part, converged));
        ASSERT_TRUE(part.error.algebraic_bound.has_value());
        EXPECT_GE(*part.error.algebraic_bound, 0.5 * errors.back()) << sweeps;
        EXPECT_EQ(part.status, Status::limit);
    }
    for (std::size_t k = 1; k < errors.size(); ++k) EXPECT_LT(errors[k], 0.7 * errors[k - 1]);
}

}  // namespace patchlight::convergence_test
