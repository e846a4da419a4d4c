#pragma once

#include "raster/camera.h"
#include "server/units.h"
#include "solver/scene/scene.h"
#include "solver/settings.h"

#include <filesystem>
#include <string>
#include <vector>

namespace patchlight::server {

struct NamedCamera {
    std::string name;
    raster::Camera camera;
    bool is_made = false;  // not given, but placed so that it frames the scene
};

/// One scene document, read: what the command line and HTTP hand to the solver.
struct Job {
    Units units;
    Scene scene;
    std::vector<NamedCamera> cameras;  // at least one
    SolveSettings settings;
    std::vector<std::filesystem::path> files;  // that its geometry was read from
};

}  // namespace patchlight::server
