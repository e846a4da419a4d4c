#pragma once

#include "server/input_errors.h"
#include "server/job.h"
#include "server/json_value.h"
#include "solver/scene/scene.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace patchlight::server {

/// The geometry files of a scene, and the cameras in them.
struct GeometryFiles {
    std::vector<std::filesystem::path> paths;
    std::vector<NamedCamera> cameras;
};

/// The blocks `objects` and `definitions` of a scene document: fills `scene.objects` with those
/// that carry geometry, named by their paths, and `scene.surfaces`. `scene.materials` must be
/// there; those of geometry files and of lamps with a `flux` are added to it. `metres` is the
/// length of one unit of the scene, `directory` where its file lies, if it has one. What is wrong
/// goes to `faults`.
GeometryFiles read_objects(const JsonValue& document, double metres,
                           const std::optional<std::filesystem::path>& directory, Scene& scene,
                           FaultList& faults);

}  // namespace patchlight::server
