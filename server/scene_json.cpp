#include "server/scene_json.h"

#include "server/cameras_json.h"
#include "server/json_document.h"
#include "server/json_value.h"
#include "server/materials_json.h"
#include "server/not_built.h"
#include "server/objects_json.h"
#include "server/sensors_json.h"
#include "server/solve_json.h"

namespace patchlight::server {
namespace {

constexpr int format_version = 1;

/// First of all: another version may have other keys.
void check_version(const JsonValue& root) {
    root.require_map();
    if (const auto version = root.find("version"))
        if (version->whole_number(0, 1'000'000) != format_version)
            version->reject("must be 1, the version of the format this program reads");
}

}  // namespace

Job read_scene(const nlohmann::json& document) {
    const JsonValue root(document);
    check_version(root);
    root.require_object(
        {"version", "units", "materials", "objects", "definitions", "cameras", "sensors", "solve"});
    refuse_not_built(root, {"definitions"});
    Job job;
    if (const auto units = root.find("units")) job.units = read_units(*units);
    if (const auto materials = root.find("materials"))
        job.scene.materials = read_materials(*materials);
    const double metres = job.units.metres;
    // The cheap blocks come before the geometry, so that their errors are told at once.
    if (const auto solve = root.find("solve")) read_solve(*solve, metres, job.settings);
    if (const auto sensors = root.find("sensors")) read_sensors(*sensors, metres, job.scene);
    if (const auto cameras = root.find("cameras")) job.cameras = read_cameras(*cameras, metres);
    const JsonValue objects = root.at("objects");
    read_objects(objects, metres, job.scene);
    root.at("version");
    constexpr int edge = 512;  // [pixels]
    if (job.cameras.empty()) job.cameras.push_back(framing_camera(job.scene, edge, edge));
    return job;
}

Job read_scene_text(std::string_view bytes) { return read_scene(parse_json(bytes)); }

}  // namespace patchlight::server
