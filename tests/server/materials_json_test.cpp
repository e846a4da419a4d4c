#include "tests/server/scene_texts.h"

#include <numbers>

namespace patchlight::server::materials_json_test {
namespace {

std::string scene_with_white(const std::string& material) {
    return scene_with("materials", R"({"white": )" + material + "}");
}

Material white(const std::string& material) {
    return read_scene_text(scene_with_white(material)).scene.materials.at(0);
}

TEST(MaterialsJson, ANumberMeansAllThreeChannels) {
    EXPECT_TRUE((white(R"({"reflectance": 0.25})").reflectance == Rgb(0.25, 0.25, 0.25)).all());
    EXPECT_TRUE(
        (white(R"({"reflectance": [0, 0.5, 0.999]})").reflectance == Rgb(0, 0.5, 0.999)).all());
}

TEST(MaterialsJson, RadianceIsExitanceOverPi) {
    const Rgb exitance = white(R"({"radiance": [1, 2, 0]})").exitance;
    EXPECT_DOUBLE_EQ(exitance[0], std::numbers::pi);
    EXPECT_DOUBLE_EQ(exitance[1], 2 * std::numbers::pi);
    EXPECT_EQ(exitance[2], 0.0);
    EXPECT_EQ(white(R"({"exitance": 7})").exitance[2], 7.0);
}

TEST(MaterialsJson, WhatIsLeftOutIsBlackDarkAndOneSided) {
    const Material material = white("{}");
    EXPECT_TRUE((material.reflectance == 0).all());
    EXPECT_TRUE((material.exitance == 0).all());
    EXPECT_FALSE(material.two_sided);
    EXPECT_TRUE(white(R"({"two_sided": true})").two_sided);
}

TEST(MaterialsJson, ReflectanceStaysBelowOne) {
    const std::string at = "/materials/white/reflectance";
    expect_rejected(scene_with_white(R"({"reflectance": 1.2})"), at, "below 1, not 1.2");
    expect_rejected(scene_with_white(R"({"reflectance": 1})"), at, "below 1");
    expect_rejected(scene_with_white(R"({"reflectance": -0.1})"), at, "at least 0");
    expect_rejected(scene_with_white(R"({"reflectance": [0.1, 0.2, 1.0]})"), at + "/2");
}

TEST(MaterialsJson, WrongTypesAreToldWhereTheyAre) {
    const std::string at = "/materials/white/reflectance";
    expect_rejected(scene_with_white(R"({"reflectance": "0.5"})"), at, "not a text");
    expect_rejected(scene_with_white(R"({"reflectance": null})"), at, "not null");
    expect_rejected(scene_with_white(R"({"reflectance": true})"), at, "not true or false");
    expect_rejected(scene_with_white(R"({"reflectance": [0.5, 0.5]})"), at, "3 numbers, not 2");
    expect_rejected(scene_with_white(R"({"reflectance": [0.5, null, 0]})"), at + "/1", "a number");
    expect_rejected(scene_with_white(R"({"two_sided": 1})"), "/materials/white/two_sided");
    expect_rejected(scene_with_white("7"), "/materials/white", "must be an object");
    expect_rejected(scene_with("materials", "[]"), "/materials", "must be an object");
}

TEST(MaterialsJson, LightIsGivenOnceAndIsNotNegative) {
    expect_rejected(scene_with_white(R"({"exitance": 1, "radiance": 1})"),
                    "/materials/white/radiance", "one of them");
    expect_rejected(scene_with_white(R"({"exitance": -1})"), "/materials/white/exitance");
    expect_rejected(scene_with_white(R"({"radiance": 1e300})"), "/materials/white/radiance");
}

TEST(MaterialsJson, UnknownKeysComeWithTheNearestKnown) {
    expect_rejected(scene_with_white(R"({"reflectence": 0.5})"), "/materials/white/reflectence",
                    "did you mean 'reflectance'?");
    expect_rejected(scene_with_white(R"({"emision": 1})"), "/materials/white/emision",
                    "known here: reflectance, exitance, radiance, two_sided");
}

TEST(MaterialsJson, NamesAreNeitherEmptyNorLongNorUnprintable) {
    expect_rejected(scene_with("materials", R"({"": {}})"), "/materials/", "empty");
    expect_rejected(scene_with("materials", R"({"a\nb": {}})"), "/materials/a\nb", "control");
}

}  // namespace
}  // namespace patchlight::server::materials_json_test
