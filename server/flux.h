#pragma once

#include "server/json_value.h"
#include "server/material_names.h"
#include "solver/scene/scene.h"

#include <string>

namespace patchlight::server {

/// Gives the emitting ones of the surfaces from number `first` on, those of the object `path`, the
/// power `flux` in all [W or lm]: spread evenly over their area, both sides where they are
/// two-sided. A number is the luminance of that power, in the colour each material has; a triple is
/// the power of each channel. Parts that other polygons cover count with the area. Each material
/// concerned is copied under the name "material@path". Throws InputError if none of them emits.
void spread_flux(const JsonValue& flux, const std::string& path, SurfaceIndex first, Scene& scene,
                 MaterialNames& names);

}  // namespace patchlight::server
