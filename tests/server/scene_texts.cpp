#include "tests/server/scene_texts.h"

namespace patchlight::server {

std::string scene_with(const std::string& block, const std::string& text) {
    nlohmann::json scene = nlohmann::json::parse(R"({
        "version": 1,
        "materials": {"white": {"reflectance": 0.5}},
        "objects": [{"name": "floor", "material": "white",
                     "polygon": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]]}]})");
    scene[block] = nlohmann::json::parse(text);
    return scene.dump();
}

std::string scene_with_object(const std::string& text) {
    return scene_with("objects", "[" + text + "]");
}

void expect_rejected(std::string_view scene, const std::string& pointer, const std::string& words) {
    try {
        read_scene_text(scene);
        ADD_FAILURE() << "accepted: " << scene.substr(0, 500);
    } catch (const InputError& error) {
        EXPECT_EQ(error.pointer(), pointer) << error.what();
        EXPECT_NE(std::string(error.what()).find(words), std::string::npos)
            << error.what() << "\nlacks: " << words;
    }
}

}  // namespace patchlight::server
