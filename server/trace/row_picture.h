#pragma once

#include "raster/camera.h"
#include "raster/image.h"
#include "server/text_sink.h"
#include "solver/patch_sight.h"
#include "solver/scene/scene.h"

namespace patchlight::server {

/// The patches a camera sees in the colours of the form factors from one patch to them, with their
/// scale; the patch itself is seen in light grey. For exposure 0. The scale ends at a round number
/// that all but 1 % of the factors do not exceed.
raster::Image row_picture(const PatchMesh& mesh, const PatchSight& sight,
                          const raster::Camera& camera);

/// patch,object,x,y,z,area,factor,hemicube_factor: a row for each patch that either sees.
void write_row_csv(const Scene& scene, const PatchMesh& mesh, const PatchSight& sight,
                   const TextSink& sink);

}  // namespace patchlight::server
