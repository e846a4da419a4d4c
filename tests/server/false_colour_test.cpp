#include "server/false_colour.h"

#include "tests/server/run_program.h"
#include "tests/server/small_box.h"
#include "tests/server/small_solution.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstring>

namespace patchlight::server::false_colour_test {
namespace {

TEST(FalseColour, RangesAreTwoNumbersWithAColon) {
    const auto range = read_shown_range("50:487.5");
    ASSERT_TRUE(range);
    EXPECT_EQ(range->least, 50.0);
    EXPECT_EQ(range->most, 487.5);
    EXPECT_TRUE(read_shown_range("0:1e-3"));
    for (const char* wrong : {"", ":", "5", "0:", ":5", "5:5", "9:5", "-1:5", "0:nan", "0:inf",
                              "0:5:9", "0 : 5", "a:b", "0:1e999"})
        EXPECT_FALSE(read_shown_range(wrong)) << wrong;
}

TEST(FalseColour, TheRangeEndsAtARoundNumberThatNearlyAllStaysBelow) {
    const Job job = small_job();
    Solution solution = small_solution();
    solution.display.radiosity.assign(3, Rgb::Constant(40));  // reflectance 0.4: 100 everywhere
    EXPECT_EQ(automatic_range(job.scene, solution).most, 100.0);
    // a spot of a 500th of the area, ten times as bright, is not let spoil the range
    solution.display.positions.insert(solution.display.positions.end(),
                                      {Vec3(0, 0, 1), Vec3(0.002, 0, 1), Vec3(0, 1, 1)});
    solution.display.radiosity.insert(solution.display.radiosity.end(), 3, Rgb::Constant(400));
    solution.display.triangles.push_back({3, 4, 5});
    solution.display.patch.push_back(1);
    EXPECT_EQ(automatic_range(job.scene, solution).most, 100.0);
    solution.display.positions[4] = Vec3(0.02, 0, 1);
    EXPECT_EQ(automatic_range(job.scene, solution).most, 1000.0);
}

TEST(FalseColour, InTheDarkThereIsARangeToo) {
    Solution dark;
    EXPECT_EQ(automatic_range(small_job().scene, dark).most, 1.0);
}

std::string solve() { return "solve " + small_box_file() + " "; }

TEST(FalseColour, PfmHoldsScalarIrradiance) {
    const Outcome outcome = run_program(solve() +
                                        "--image f.pfm --image l.pfm --false-colour"
                                        " --size 8x6 --stats f.json");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    run_program(solve() + "--image l.pfm --size 8x6");
    const std::string irradiance = read_test_file("f.pfm"), radiance = read_test_file("l.pfm");
    ASSERT_EQ(irradiance.size(), radiance.size());
    const auto number = [](const std::string& bytes, std::size_t from_end) {
        float read = 0;
        std::memcpy(&read, bytes.data() + bytes.size() - from_end, sizeof read);
        return static_cast<double>(read);
    };
    constexpr double pi_over_reflectance = 3.14159265 / 0.7;  // of the walls, which are all it sees
    for (const std::size_t from_end : {12u, 120u, 300u})
        EXPECT_NEAR(number(irradiance, from_end), pi_over_reflectance * number(radiance, from_end),
                    1e-4);
    const auto image = nlohmann::json::parse(read_test_file("f.json"))["images"][0];
    EXPECT_EQ(image["false_colour"], nlohmann::json({{"unit", "W/m²"}}));
}

TEST(FalseColour, PngHasColoursAndAScaleAndSaysItsRange) {
    const Outcome outcome =
        run_program(solve() + "--image f.png --false-colour 0.5:20 --size 80x60 --stats f.json");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const auto image = nlohmann::json::parse(read_test_file("f.json"))["images"][0];
    EXPECT_EQ(image["false_colour"],
              nlohmann::json({{"min", 0.5}, {"max", 20.0}, {"unit", "W/m²"}}));
    EXPECT_FALSE(image.contains("exposure"));
    EXPECT_EQ(image["height"], 60);
    EXPECT_GT(image["width"], 100);
    const std::string png = read_test_file("f.png");
    ASSERT_TRUE(png.starts_with("\x89PNG"));
    const int width =
        static_cast<unsigned char>(png[19]) + 256 * static_cast<unsigned char>(png[18]);
    EXPECT_EQ(width, image["width"]);
}

TEST(FalseColour, ItsValueMayBeLeftOutWhereverTheSceneStands) {
    for (const char* arguments :
         {"--false-colour box.json --image a.pfm", "--image a.pfm --false-colour box.json",
          "box.json --image a.pfm --false-colour", "box.json --false-colour --image a.pfm",
          "--false-colour 0:5 box.json --image a.pfm",
          "--false-colour=0:5 --image a.pfm box.json"}) {
        small_box_file();
        const Outcome outcome = run_program(std::string("solve ") + arguments);
        EXPECT_EQ(outcome.code, 0) << arguments << "\n" << outcome.err;
    }
}

TEST(FalseColour, WhatIsWrongIsTold) {
    for (const auto& [arguments, words] :
         {std::pair{"--image a.png --false-colour 5:1", "--false-colour: must be MIN:MAX"},
          {"--image a.png --false-colour 500", "must be MIN:MAX"},
          {"--false-colour", "--image"},
          {"--image a.png --false-colour --exposure 1", "--exposure: means nothing"}}) {
        const Outcome outcome = run_program(solve() + arguments);
        EXPECT_EQ(outcome.code, 2) << arguments << outcome.err;
        EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(run_program("solve --image a.png --false-colour 0:5").code, 2);  // no scene
}

}  // namespace
}  // namespace patchlight::server::false_colour_test
