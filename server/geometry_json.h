#pragma once

#include "server/json_value.h"
#include "solver/scene/scene.h"

#include <Eigen/Geometry>

namespace patchlight::server {

/// Where the polygons of one object go.
struct Placement {
    ObjectIndex object = 0;
    MaterialIndex material = 0;
    Eigen::Affine3d to_scene = Eigen::Affine3d::Identity();  // from own coordinates to metres
};

/// Adds one polygon, [[x, y, z], …]. If the placement mirrors, its front stays its front.
void read_polygon(const JsonValue& body, const Placement& placement, Scene& scene);

/// Adds an indexed face set, {"vertices": […], "faces": […]}, in the same way.
void read_mesh(const JsonValue& mesh, const Placement& placement, Scene& scene);

}  // namespace patchlight::server
