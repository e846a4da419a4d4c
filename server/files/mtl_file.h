#pragma once

#include "server/files/imported_geometry.h"

#include <string>
#include <string_view>
#include <vector>

namespace patchlight::server {

/// The materials of an MTL file: Kd is the reflectance (none, where it is 0 and map_Kd stands
/// beside it), Ke the radiance; map_Kd and map_Ke are textures by the names they are given, their
/// paths empty; transparency is noticed however it is written; what else there is has no meaning
/// for diffuse light. `file` is how messages call it. Throws InputError at "file:line".
std::vector<FileMaterial> read_mtl(std::string_view text, const std::string& file);

}  // namespace patchlight::server
