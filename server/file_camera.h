#pragma once

#include "server/files/imported_geometry.h"
#include "server/job.h"

#include <Eigen/Geometry>

namespace patchlight::server {

/// A camera of a geometry file in a scene [m]. Its picture is 512 pixels along the longer side.
NamedCamera placed_camera(const FileCamera& given, const Eigen::Affine3d& to_scene);

}  // namespace patchlight::server
