#include "solver/solve_plan.h"

#include "solver/mesh/make_patches.h"
#include "solver/scene/input_error.h"
#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace patchlight::solve_plan_test {
namespace {

std::string refused_at(const std::function<void(SolveSettings&)>& change) {
    SolveSettings settings;
    change(settings);
    try {
        plan_solve(room(), settings);
    } catch (const InputError& error) {
        return error.pointer();
    }
    return "not refused";
}

TEST(PlanSolve, CarriesLightOnClustersToAnAccuracyAlone) {
    EXPECT_EQ(refused_at([](SolveSettings& s) {
                  s.method = Method::hierarchical;
                  s.patch_size = 0.1;
              }),
              "/solve/solver");
    EXPECT_EQ(refused_at([](SolveSettings& s) {
                  s.method = Method::hierarchical;
                  s.accuracy = 0.1;
                  s.engine = Engine::hemicube;
              }),
              "/solve/form_factors");
    SolveSettings given;
    given.method = Method::hierarchical;
    const SolveSettings planned = plan_solve(room(), given).settings;
    EXPECT_EQ(planned.engine, Engine::ray_cast);
    EXPECT_TRUE(planned.accuracy);
}

TEST(PlanSolve, RefusesSettingsThatWouldDoNothing) {
    EXPECT_EQ(refused_at([](SolveSettings& s) {
                  s.ambient = true;
                  s.method = Method::gauss_seidel;
              }),
              "/solve/ambient");
    EXPECT_EQ(refused_at([](SolveSettings& s) {
                  s.hemicube_resolution = 256;
                  s.engine = Engine::analytic;
              }),
              "/solve/hemicube_resolution");
    EXPECT_EQ(refused_at([](SolveSettings& s) {
                  s.rays = 256;
                  s.engine = Engine::hemicube;
              }),
              "/solve/rays");
}

TEST(PlanSolve, ChoosesWhatASettingBelongsTo) {
    SolveSettings given;
    given.hemicube_resolution = 256;
    given.ambient = true;
    const SolveSettings planned = plan_solve(room(), given).settings;
    EXPECT_EQ(planned.engine, Engine::hemicube);
    EXPECT_EQ(planned.hemicube_resolution, 256);
    EXPECT_FALSE(planned.rays);
    EXPECT_EQ(planned.method, Method::shooting);
}

TEST(PlanSolve, MakesEveryChoice) {
    const SolvePlan plan = plan_solve(room(), {});
    EXPECT_EQ(plan.settings.method, Method::gauss_seidel);
    EXPECT_EQ(plan.settings.engine, Engine::analytic);
    EXPECT_EQ(plan.settings.accuracy, 0.02);
    EXPECT_TRUE(plan.settings.patch_size);
    EXPECT_TRUE(plan.settings.rays && plan.settings.tolerance && plan.settings.max_iterations &&
                plan.settings.memory_limit);
    EXPECT_GE(plan.settings.threads, 1);
    EXPECT_FALSE(plan.settings.time_limit);
    EXPECT_FALSE(plan.why.empty());
}

TEST(PlanSolve, HasNoTargetWhereSomethingIsSetByHand) {
    const auto accuracy = [](const std::function<void(SolveSettings&)>& change) {
        SolveSettings settings;
        change(settings);
        return plan_solve(room(), settings).settings.accuracy;
    };
    EXPECT_FALSE(accuracy([](SolveSettings& s) { s.patch_size = 0.5; }));
    EXPECT_FALSE(accuracy([](SolveSettings& s) { s.rays = 64; }));
    EXPECT_FALSE(accuracy([](SolveSettings& s) { s.hemicube_resolution = 64; }));
    EXPECT_FALSE(accuracy([](SolveSettings& s) { s.tolerance = 1e-3; }));
    EXPECT_FALSE(accuracy([](SolveSettings& s) { s.max_iterations = 10; }));
    EXPECT_EQ(accuracy([](SolveSettings& s) { s.seed = 7; }), 0.02);
    EXPECT_EQ(accuracy([](SolveSettings& s) {
                  s.patch_size = 0.5;
                  s.accuracy = 0.1;
              }),
              0.1);
}

TEST(PlanSolve, ShootsWhereTheMatrixWouldNotFit) {
    SolveSettings settings;
    settings.patch_size = 0.01;  // 60 000 patches
    settings.memory_limit = std::uint64_t{1} << 30;
    const SolvePlan plan = plan_solve(room(), settings);
    EXPECT_EQ(plan.settings.method, Method::shooting);
    EXPECT_EQ(plan.settings.engine, Engine::ray_cast);
    EXPECT_NE(plan.why.find("not fit"), std::string::npos) << plan.why;
    settings.method = Method::gauss_seidel;
    EXPECT_EQ(plan_solve(room(), settings).settings.method, Method::gauss_seidel);
}

TEST(PlanSolve, KeepsWhatIsGiven) {
    SolveSettings given;
    given.engine = Engine::ray_cast;
    given.patch_size = 0.5;
    given.rays = 77;
    given.tolerance = 1e-3;
    given.max_iterations = 5;
    given.memory_limit = 12345;
    given.threads = 3;
    given.seed = 9;
    const SolveSettings planned = plan_solve(room(), given).settings;
    EXPECT_EQ(planned.engine, Engine::ray_cast);
    EXPECT_EQ(planned.patch_size, 0.5);
    EXPECT_EQ(planned.rays, 77);
    EXPECT_EQ(planned.tolerance, 1e-3);
    EXPECT_EQ(planned.max_iterations, 5);
    EXPECT_EQ(planned.memory_limit, 12345u);
    EXPECT_EQ(planned.threads, 3);
    EXPECT_EQ(planned.seed, 9u);
}

TEST(PlanSolve, SaysWhetherTheSceneIsGrey) {
    Scene coloured = room();
    EXPECT_TRUE(is_grey(coloured));
    const std::string grey_why = plan_solve(coloured, {}).why;
    coloured.materials[white].reflectance = Rgb(0.5, 0.4, 0.5);
    EXPECT_FALSE(is_grey(coloured));
    EXPECT_NE(plan_solve(coloured, {}).why, grey_why);
}

TEST(CheckMemory, NamesBothNumbersWhenItRefuses) {
    SolveSettings settings;
    settings.memory_limit = 123456789;
    const SolveSettings planned = plan_solve(room(), settings).settings;
    try {
        check_memory(room(), 100000, planned);
        FAIL() << "not refused";
    } catch (const InputError& error) {
        const std::string text = error.what();
        EXPECT_EQ(error.pointer(), "/solve/patch_size");
        EXPECT_NE(text.find("123456789"), std::string::npos) << text;
        EXPECT_NE(text.find(std::to_string(estimate_memory(room(), 100000, planned))),
                  std::string::npos)
            << text;
    }
}

TEST(CheckMemory, SaysInWordsWhatNoMachineHas) {
    const SolveSettings planned = plan_solve(room(), {}).settings;
    try {
        check_memory(room(), std::size_t{1} << 40, planned);
        FAIL() << "not refused";
    } catch (const InputError& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("more bytes than any machine has"), std::string::npos) << text;
        EXPECT_EQ(text.find("18446744073709551615"), std::string::npos) << text;
    }
}

TEST(CheckMemory, LetsPassWhatFits) {
    SolveSettings settings;
    settings.memory_limit = std::uint64_t{1} << 30;
    EXPECT_NO_THROW(check_memory(room(), 1000, plan_solve(room(), settings).settings));
}

TEST(EstimateMemory, GrowsWithThePatchesAndDoesNotOverflow) {
    const SolveSettings planned = plan_solve(room(), {}).settings;
    EXPECT_GT(estimate_memory(room(), 10000, planned), 400'000'000u);  // the matrix alone
    EXPECT_LT(estimate_memory(room(), 10000, planned), 4'000'000'000u);
    std::uint64_t before = 0;
    for (std::size_t patches = 1; patches < std::size_t{1} << 60; patches *= 16) {
        EXPECT_GE(estimate_memory(room(), patches, planned), before);
        before = estimate_memory(room(), patches, planned);
    }
    EXPECT_GT(before, std::uint64_t{1} << 62);
}

TEST(EstimateMemory, OfShootingStaysFarBelowTheMatrix) {
    SolveSettings settings;
    const SolveSettings matrix = plan_solve(room(), settings).settings;
    settings.method = Method::shooting;
    const SolveSettings shooting = plan_solve(room(), settings).settings;
    EXPECT_LT(estimate_memory(room(), 20000, shooting), 200'000'000u);
    EXPECT_GT(estimate_memory(room(), 20000, matrix),
              20 * estimate_memory(room(), 20000, shooting));
}

TEST(EstimateCost, KnowsThePatchesBeforeTheyAreMade) {
    SolveSettings settings;
    settings.patch_size = 0.1;
    const CostEstimate cost = estimate_cost(room(), settings);
    EXPECT_EQ(cost.patches, 600u);
    EXPECT_GT(cost.memory, 0u);
    EXPECT_GT(cost.seconds, 0.0);
}

TEST(EstimateCost, CountsWhatOutlinesAndContactsAdd) {
    const std::vector<Scene> scenes{scene_of(regular(500, 1.0)), room_with_box(),
                                    scene_of(flat({{0, 0}, {1, 0}, {1, 1e-5}}))};
    for (const Scene& scene : scenes) {
        SolveSettings settings;
        settings.patch_size = 0.3;
        EXPECT_EQ(estimate_cost(scene, settings).patches, cut(scene, 0.3).mesh.size());
    }
}

TEST(SolveScene, RefusesASceneThatWouldNotFit) {
    SolveSettings settings;
    settings.patch_size = 1e-5;
    EXPECT_THROW(solve_scene(room(), settings, {}), InputError);
}

TEST(SolveScene, RefusesASceneWithNothingInIt) {
    try {
        solve_scene(empty_scene(), {}, {});
        FAIL() << "not refused";
    } catch (const InputError& error) {
        EXPECT_EQ(error.pointer(), "/objects");
    }
}

}  // namespace
}  // namespace patchlight::solve_plan_test
