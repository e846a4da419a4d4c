#include "server/scene_json.h"

#include "server/cameras_json.h"
#include "server/doubts.h"
#include "server/files/known_formats.h"
#include "server/input_errors.h"
#include "server/json_document.h"
#include "server/json_value.h"
#include "server/materials_json.h"
#include "server/objects_json.h"
#include "server/sensors_json.h"
#include "server/solve_json.h"

#include "solver/scene/far_reaching.h"

#include <utility>
#include <vector>

namespace patchlight::server {
namespace {

constexpr int format_version = 1;

bool is_text(const nlohmann::json& document, const char* key, std::string_view text) {
    const auto value = document.find(key);
    return value != document.end() && value->is_string() &&
           value->get_ref<const std::string&>() == text;
}

/// JSON documents of other programs, told by keys that they must have.
void refuse_foreign(const nlohmann::json& document, const JsonValue& root) {
    const bool is_of_this_format = root.has("version") && root.has("objects");
    if (is_of_this_format) return;
    if (root.has("asset") && (root.has("nodes") || root.has("scenes") || root.has("meshes")))
        root.reject("is glTF by its content; give its name the ending .gltf");
    if (is_text(document, "type", "CityJSON"))
        root.reject("is CityJSON, which is not read; convert it to OBJ");
    if (is_text(document, "type", "Model") && root.has("rooms"))
        root.reject("is a Honeybee model, which is not read; write its faces as `objects`");
    if (is_text(document, "type", "FeatureCollection"))
        root.reject("is GeoJSON, which is not read; a scene has `objects` with surfaces");
    if (root.has("metadata") && root.has("geometries"))
        root.reject("is a three.js scene, which is not read; export it as glTF");
    if (root.has("patchlight") && root.has("energy"))
        root.reject("is a result, not a scene; its `settings` are what applied");
}

/// First of all: another version may have other keys.
void check_version(const nlohmann::json& document, const JsonValue& root) {
    root.require_map();
    refuse_foreign(document, root);
    if (const auto version = root.find("version"))
        if (version->whole_number(0, 1'000'000) != format_version)
            version->reject("must be 1, the version of the format this program reads");
}

/// The blocks that are cheap to read come first. Returns false if the objects cannot be judged
/// without what is wrong with them.
bool read_blocks(const JsonValue& root, Job& job, FaultList& faults) {
    bool is_ready = true;
    if (const auto units = root.find("units"))
        is_ready &= faults.attempt([&] { job.units = read_units(*units); });
    if (const auto materials = root.find("materials"))
        is_ready &=
            faults.attempt([&] { job.scene.materials = read_materials(*materials, faults); });
    const double metres = job.units.metres;
    if (const auto solve = root.find("solve"))
        faults.attempt([&] { read_solve(*solve, metres, job.settings); });
    if (const auto sensors = root.find("sensors"))
        faults.attempt([&] { read_sensors(*sensors, metres, job.scene); });
    if (const auto cameras = root.find("cameras"))
        faults.attempt([&] { job.cameras = read_cameras(*cameras, metres); });
    return is_ready;
}

/// What is no JSON may be a scene of another kind.
nlohmann::json parse_scene(std::string_view bytes) {
    try {
        return parse_json(bytes);
    } catch (const JsonError& error) {
        const std::string what = foreign_content(bytes);
        if (what.empty()) throw;
        throw JsonError(error.fault(), "", what);
    }
}

}  // namespace

Job read_scene(const nlohmann::json& document, const SceneSource& source) {
    const JsonValue root(document);
    check_version(document, root);
    Job job;
    FaultList faults;
    const bool keys_known = faults.attempt([&] {
        root.require_object({"version", "units", "materials", "objects", "definitions", "cameras",
                             "sensors", "solve"});
    });
    const bool is_ready = read_blocks(root, job, faults);
    // A misspelt 'objects' is told of as an unknown key.
    GeometryFiles files;
    if (is_ready && (keys_known || root.has("objects")))
        faults.attempt([&] {
            files = read_objects(root, job.units.metres, source.directory, job.scene, faults);
        });
    if (!root.has("version"))
        faults.attempt([&] {
            root.reject("needs 'version'; write \"version\": 1, the format this program reads");
        });
    faults.throw_if_any();
    settle_far_geometry(job.scene);
    if (job.cameras.empty()) job.cameras = std::move(files.cameras);
    job.files = std::move(files.paths);
    constexpr int edge = 512;  // [pixels]
    for (Finding& doubt : doubts(job)) job.scene.findings.push_back(std::move(doubt));
    if (job.cameras.empty()) job.cameras.push_back(framing_camera(job.scene, edge, edge));
    return job;
}

Job read_scene_text(std::string_view bytes, const SceneSource& source) {
    struct Document {
        nlohmann::json root;
        ~Document() { dismantle(root); }
    };
    const Document document{parse_scene(bytes)};
    return read_scene(document.root, source);
}

}  // namespace patchlight::server
