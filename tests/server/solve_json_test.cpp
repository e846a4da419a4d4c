#include "server/solve_json.h"

#include "tests/server/scene_texts.h"

namespace patchlight::server::solve_json_test {
namespace {

SolveSettings settings_of(const std::string& block) {
    return read_scene_text(scene_with("solve", block)).settings;
}

void expect_setting_rejected(const std::string& key, const std::string& value,
                             const std::string& words = "") {
    expect_rejected(scene_with("solve", "{\"" + key + "\": " + value + "}"), "/solve/" + key,
                    words);
}

TEST(SolveJson, EverySettingIsRead) {
    const SolveSettings settings = settings_of(R"({
        "solver": "gauss-seidel", "form_factors": "ray-cast", "patch_size": 0.25, "rays": 1e4,
        "tolerance": 1e-6, "max_iterations": 50, "seed": 18446744073709551615, "time_limit": 2.5,
        "memory_limit": 1000000000})");
    EXPECT_EQ(settings.method, Method::gauss_seidel);
    EXPECT_EQ(settings.engine, Engine::ray_cast);
    EXPECT_EQ(settings.patch_size, 0.25);
    EXPECT_EQ(settings.rays, 10'000);
    EXPECT_EQ(settings.tolerance, 1e-6);
    EXPECT_EQ(settings.max_iterations, 50);
    EXPECT_EQ(settings.seed, 18446744073709551615u);
    EXPECT_EQ(settings.time_limit, 2.5);
    EXPECT_EQ(settings.memory_limit, 1'000'000'000u);
}

TEST(SolveJson, WhatIsLeftOutIsLeftToTheSolver) {
    const SolveSettings settings = settings_of("{}");
    EXPECT_EQ(settings.method, Method::automatic);
    EXPECT_EQ(settings.engine, Engine::automatic);
    EXPECT_FALSE(settings.patch_size || settings.rays || settings.tolerance || settings.accuracy);
}

TEST(SolveJson, ThePatchSizeIsInTheUnitOfTheScene) {
    nlohmann::json scene = nlohmann::json::parse(scene_with("solve", R"({"patch_size": 50})"));
    scene["units"] = {{"length", "mm"}};
    EXPECT_DOUBLE_EQ(*read_scene_text(scene.dump()).settings.patch_size, 0.05);
}

TEST(SolveJson, WrongSettingsAreRefused) {
    expect_setting_rejected("solver", "\"gaus-seidel\"", "did you mean 'gauss-seidel'?");
    expect_setting_rejected("solver", "3", "must be a text");
    expect_setting_rejected("form_factors", "\"raycast\"", "did you mean 'ray-cast'?");
    expect_setting_rejected("accuracy", "0", "above 0");
    expect_setting_rejected("accuracy", "1");
    expect_setting_rejected("accuracy", "-0.1");
    expect_setting_rejected("patch_size", "0", "above 0");
    expect_setting_rejected("patch_size", "-1");
    expect_setting_rejected("patch_size", "1e-200", "cannot be made");
    expect_setting_rejected("rays", "0", "from 1 to 16777216, not 0");
    expect_setting_rejected("rays", "10000000000");
    expect_setting_rejected("rays", "1.5", "whole number");
    expect_setting_rejected("hemicube_resolution", "1", "from 2 to 4096, not 1");
    expect_setting_rejected("ambient", "1");
    expect_setting_rejected("tolerance", "0");
    expect_setting_rejected("tolerance", "1", "below 1");
    expect_setting_rejected("max_iterations", "0");
    expect_setting_rejected("seed", "-1");
    expect_setting_rejected("seed", "0.5");
    expect_setting_rejected("time_limit", "0", "above 0");
    expect_setting_rejected("memory_limit", "0", "above 0");
    expect_setting_rejected("memory_limit", "-5");
    expect_setting_rejected("patchsize", "1", "did you mean 'patch_size'?");
}

TEST(SolveJson, TheEchoReadsBackAsTheSame) {
    const SolveSettings settings = settings_of(R"({"solver": "gauss-seidel", "rays": 64,
        "form_factors": "analytic", "patch_size": 0.1, "tolerance": 0.001, "seed": 9})");
    const nlohmann::json echo = nlohmann::json::parse(solve_block(settings).dump());
    SolveSettings again;
    read_solve(JsonValue(echo), 1.0, again);
    EXPECT_EQ(solve_block(again), solve_block(settings));
}

}  // namespace
}  // namespace patchlight::server::solve_json_test
