#include "server/scene_json.h"

#include "server/cameras_json.h"
#include "server/input_errors.h"
#include "server/json_document.h"
#include "server/json_value.h"
#include "server/materials_json.h"
#include "server/objects_json.h"
#include "server/sensors_json.h"
#include "server/solve_json.h"

#include "solver/scene/far_reaching.h"

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

}  // namespace

Job read_scene(const nlohmann::json& document, const SceneSource& source) {
    const JsonValue root(document);
    check_version(root);
    Job job;
    FaultList faults;
    const bool keys_known = faults.attempt([&] {
        root.require_object({"version", "units", "materials", "objects", "definitions", "cameras",
                             "sensors", "solve"});
    });
    const bool is_ready = read_blocks(root, job, faults);
    // A misspelt 'objects' is told of as an unknown key.
    if (is_ready && (keys_known || root.has("objects")))
        faults.attempt(
            [&] { read_objects(root, job.units.metres, source.directory, job.scene, faults); });
    faults.attempt([&] { root.at("version"); });
    faults.throw_if_any();
    settle_far_geometry(job.scene);
    constexpr int edge = 512;  // [pixels]
    if (job.cameras.empty()) job.cameras.push_back(framing_camera(job.scene, edge, edge));
    return job;
}

Job read_scene_text(std::string_view bytes, const SceneSource& source) {
    struct Document {
        nlohmann::json root;
        ~Document() { dismantle(root); }
    };
    const Document document{parse_json(bytes)};
    return read_scene(document.root, source);
}

}  // namespace patchlight::server
