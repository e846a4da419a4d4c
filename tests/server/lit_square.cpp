#include "tests/server/lit_square.h"

#include <nlohmann/json.hpp>

namespace patchlight::server {
namespace {

const char* const lamp_object =
    R"({"name": "lamp", "material": "lamp", "polygon": [[0,0,1],[0,1,1],[1,1,1],[1,0,1]]})";

}  // namespace

std::string lit_square(const std::string& changes) {
    auto scene = nlohmann::json::parse(R"({
        "version": 1,
        "materials": {"white": {"reflectance": 0.5}, "lamp": {"reflectance": 0.5, "exitance": 10}},
        "objects": [{"name": "floor", "material": "white",
                     "polygon": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]]}],
        "cameras": [{"name": "main", "eye": [0.5,-2,0.5], "look_at": [0.5,0,0.5], "up": [0,0,1],
                     "size": [8,8]}],
        "solve": {"patch_size": 0.5}})");
    scene["objects"].push_back(nlohmann::json::parse(lamp_object));
    scene.merge_patch(nlohmann::json::parse(changes));
    return scene.dump();
}

std::string lit_object(const std::string& members) {
    return lit_square(R"({"objects": [{"name": "odd", "material": "white", )" + members + "}, " +
                      lamp_object + "]}");
}

}  // namespace patchlight::server
