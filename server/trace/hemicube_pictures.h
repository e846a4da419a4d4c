#pragma once

#include "raster/image.h"
#include "server/trace/patch_colours.h"
#include "solver/form_factors/hemicube_faces.h"

#include <array>
#include <string>
#include <vector>

namespace patchlight::server {

/// The five faces in the colours of the patches that their cells see, each cell some pixels wide;
/// for exposure 0. Backs are dark grey, what leads out of the scene is black.
std::array<raster::Image, 5> face_pictures(const std::array<HemicubeFace, 5>& faces,
                                           const PatchColours& colours);

/// All five as one picture: the top in the middle, each side folded out where it adjoins, its
/// horizon outside. In the colours of patches, or of the delta form factors with their scale.
raster::Image unfolded_patches(const std::array<HemicubeFace, 5>& faces,
                               const PatchColours& colours);
raster::Image unfolded_delta_factors(const std::array<HemicubeFace, 5>& faces);

}  // namespace patchlight::server
