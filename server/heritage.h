#pragma once

#include "solver/scene/scene.h"

#include <Eigen/Geometry>

#include <optional>
#include <string>

namespace patchlight::server {

/// What an object has from those it is a child of, and then of itself.
struct Heritage {
    std::string path;
    std::optional<MaterialIndex> material;                   // the nearest one at or above it
    Eigen::Affine3d to_scene = Eigen::Affine3d::Identity();  // from own coordinates to metres
};

}  // namespace patchlight::server
