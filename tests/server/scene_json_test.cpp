#include "tests/server/scene_texts.h"

#include "server/json_document.h"

namespace patchlight::server::scene_json_test {
namespace {

TEST(SceneJson, TheTopIsAnObjectWithKnownKeys) {
    expect_rejected("[]", "", "must be an object, not an array");
    expect_rejected("\"x\"", "", "must be an object, not a text");
    expect_rejected("7", "");
    expect_rejected("{}", "", "needs 'objects'");
    expect_rejected(R"({"materials": 7})", "/materials");
    expect_rejected(scene_with("material", "{}"), "/material", "did you mean 'materials'?");
    expect_rejected(scene_with("a/b~c", "{}"), "/a~1b~0c", "unknown key");
}

TEST(SceneJson, TheVersionIsOne) {
    expect_rejected(scene_with("version", "2"), "/version", "must be 1");
    expect_rejected(scene_with("version", "1.5"), "/version");
    expect_rejected(scene_with("version", "\"1\""), "/version", "must be a number");
    nlohmann::json scene = nlohmann::json::parse(scene_with("version", "1"));
    scene.erase("version");
    expect_rejected(scene.dump(), "", "needs 'version'");
}

TEST(SceneJson, AnotherVersionIsToldBeforeItsUnknownKeys) {
    expect_rejected(R"({"version": 2, "shapes": []})", "/version");
}

TEST(SceneJson, UnitsAreKnownOnes) {
    expect_rejected(scene_with("units", R"({"length": "km"})"), "/units/length", "unknown unit");
    expect_rejected(scene_with("units", R"({"length": 1})"), "/units/length", "must be a text");
    expect_rejected(scene_with("units", R"({"light": "photometrc"})"), "/units/light",
                    "did you mean 'photometric'?");
    expect_rejected(scene_with("units", R"({"lenght": "m"})"), "/units/lenght",
                    "did you mean 'length'?");
    expect_rejected(scene_with("units", "\"mm\""), "/units", "must be an object");
}

TEST(SceneJson, TheUnitOfLightIsKept) {
    const Job job = read_scene_text(scene_with("units", R"({"light": "photometric"})"));
    EXPECT_EQ(job.units.light, LightUnit::photometric);
    EXPECT_EQ(job.units.length, "m");
}

TEST(SceneJson, ADuplicateKeyIsRefusedBeforeTheSceneIsRead) {
    EXPECT_THROW(read_scene_text(R"({"version": 1, "objects": [], "objects": []})"), JsonError);
    expect_rejected(R"({"materials": {"a": {}, "a": {}}})", "/materials/a", "given twice");
}

}  // namespace
}  // namespace patchlight::server::scene_json_test
