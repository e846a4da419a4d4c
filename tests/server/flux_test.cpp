#include "tests/server/scene_texts.h"

namespace patchlight::server::flux_test {
namespace {

constexpr double rounding = 1e-12;

const std::string square = R"("polygon": [[0,0,0],[2,0,0],[2,2,0],[0,2,0]])";  // 4 m²

std::string scene(const std::string& object,
                  const std::string& lamp = R"({"exitance": [3, 2, 1]})") {
    return R"({"version": 1, "materials": {"lamp": )" + lamp +
           R"(, "dark": {"reflectance": 0.5}}, "objects": [)" + object + "]}";
}

Scene read(const std::string& object, const std::string& lamp = R"({"exitance": [3, 2, 1]})") {
    return read_scene_text(scene(object, lamp)).scene;
}

/// All that leaves the surfaces by itself [W].
Rgb power(const Scene& scene) {
    Rgb sum = Rgb::Zero();
    for (const Surface& surface : scene.surfaces)
        sum += surface.area * scene.materials[surface.material].exitance;
    return sum;
}

TEST(Flux, ANumberIsLuminanceInTheColourOfTheMaterial) {
    const Rgb emitted = power(read(R"({"material": "lamp", "flux": 100, )" + square + "}"));
    EXPECT_NEAR(luminance(emitted), 100, 100 * rounding);
    EXPECT_NEAR(emitted[0] / emitted[2], 3.0, rounding);
    EXPECT_NEAR(emitted[1] / emitted[2], 2.0, rounding);
}

TEST(Flux, ATripleIsThePowerOfEachChannel) {
    const Rgb emitted = power(read(R"({"material": "lamp", "flux": [7, 0, 2], )" + square + "}"));
    EXPECT_NEAR((emitted - Rgb(7, 0, 2)).abs().maxCoeff(), 0, 10 * rounding);
}

TEST(Flux, BothSidesShareIt) {
    const Scene scene = read(R"({"material": "lamp", "flux": 100, )" + square + "}",
                             R"({"exitance": 1, "two_sided": true})");
    ASSERT_EQ(scene.surfaces.size(), 2u);
    EXPECT_NEAR(scene.materials[scene.surfaces[0].material].exitance[0], 100.0 / 8, rounding);
}

TEST(Flux, IsSpreadEvenlyOverTheEmittingFrontsOfAllDescendants) {
    const Scene scene = read(R"({"name": "l", "flux": 60, "children": [
        {"name": "small", "material": "lamp", "polygon": [[0,0,-1],[1,0,-1],[1,1,-1],[0,1,-1]]},
        {"name": "box", "material": "dark", )" +
                                 square + R"(},
        {"name": "large", "material": "lamp", "translation": [0,0,1], )" +
                                 square + "}]}",
                             R"({"exitance": 1})");
    EXPECT_NEAR(power(scene)[0], 60, 60 * rounding);
    EXPECT_EQ(scene.surfaces[0].material, scene.surfaces[2].material);
    EXPECT_NEAR(scene.materials[scene.surfaces[0].material].exitance[0], 12, 12 * rounding);
    EXPECT_EQ(scene.materials[scene.surfaces[1].material].name, "dark");
}

TEST(Flux, LeavesOtherObjectsOfTheMaterialAlone) {
    const Scene scene = read(R"({"name": "a", "material": "lamp", "flux": 8, )" + square + R"(},
        {"name": "b", "material": "lamp", "translation": [0,0,1], )" +
                             square + "}");
    EXPECT_EQ(scene.materials[scene.surfaces[0].material].name, "lamp@a");
    EXPECT_EQ(scene.materials[scene.surfaces[1].material].name, "lamp");
    EXPECT_EQ(scene.materials[scene.surfaces[1].material].exitance[0], 3.0);
}

TEST(Flux, InADefinitionIsThatOfEachInstance) {
    const Job job = read_scene_text(R"({"version": 1, "materials": {"lamp": {"exitance": 1}},
        "definitions": {"bulb": {"material": "lamp", "flux": 5, )" +
                                    square + R"(}},
        "objects": [{"instance": "bulb"}, {"instance": "bulb", "scale": 3, "translation": [0, 0, 1]},
                    {"instance": "bulb", "flux": 9, "translation": [0, 0, 2]}]})");
    for (const auto& [surface, flux] : {std::pair{0, 5.0}, {1, 5.0}, {2, 9.0}}) {
        const Surface& lit = job.scene.surfaces[static_cast<std::size_t>(surface)];
        EXPECT_NEAR(lit.area * job.scene.materials[lit.material].exitance[0], flux, 1e-11);
    }
    EXPECT_EQ(job.scene.materials.size(), 4u);  // the lamp, and one for each instance
}

TEST(Flux, OfZeroPutsTheLampOut) {
    const Scene scene = read(R"({"material": "lamp", "flux": 0, )" + square + "}");
    EXPECT_EQ(power(scene).sum(), 0.0);
}

TEST(Flux, NeedsAMaterialThatEmitsAndARightNumber) {
    const auto object = [](const std::string& material, const std::string& flux) {
        return scene(R"({"material": ")" + material + R"(", "flux": )" + flux + ", " + square +
                     "}");
    };
    expect_rejected(object("dark", "10"), "/objects/0/flux", "no material of the object emits");
    expect_rejected(object("lamp", "-1"), "/objects/0/flux", "at least 0");
    expect_rejected(object("lamp", "[1, 2]"), "/objects/0/flux", "3 numbers, not 2");
    expect_rejected(object("lamp", "\"5 lm\""), "/objects/0/flux", "must be a number");
    expect_rejected(object("lamp", "1e30"), "/objects/0/flux", "at most 1e+15");
    expect_rejected(scene(R"({"scale": 1e-8, "material": "lamp", "flux": 1e6, )" + square + "}"),
                    "/objects/0/flux", "is too much for an area of");
}

TEST(Flux, WhatIsCoveredTakesNoShareOfIt) {
    const std::string cover =
        R"(, {"material": "dark", "polygon": [[1,0,0],[3,0,0],[3,2,0],[1,2,0]]})";
    const Scene half =
        read(R"({"material": "lamp", "flux": 100, )" + square + "}" + cover, R"({"exitance": 1})");
    EXPECT_NEAR(half.materials[half.surfaces[0].material].exitance[0], 50.0, 50 * rounding);
}

TEST(Flux, OfAFaceGivenTwiceIsThatOfOne) {
    const std::string twice = R"("mesh": {"vertices": [[0,0,0],[2,0,0],[2,2,0],[0,2,0]],
                                          "faces": [[0,1,2,3],[2,3,0,1]]})";
    const Scene scene =
        read(R"({"material": "lamp", "flux": 100, )" + twice + "}", R"({"exitance": 1})");
    EXPECT_NEAR(scene.materials[scene.surfaces[0].material].exitance[0], 25.0, 25 * rounding);
}

TEST(Flux, OnWhatIsWhollyCoveredIsAnError) {
    const std::string cover =
        R"(, {"material": "dark", "polygon": [[-1,0,0],[3,0,0],[3,2,0],[-1,2,0]]})";
    expect_rejected(scene(R"({"material": "lamp", "flux": 100, )" + square + "}" + cover),
                    "/objects/0/flux", "is covered by polygons in its plane");
}

}  // namespace
}  // namespace patchlight::server::flux_test
