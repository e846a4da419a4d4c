#pragma once

#include "server/files/gltf_accessors.h"
#include "solver/scene/light.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace patchlight::server {

/// Triangles of one primitive of a glTF mesh, in its own coordinates [m].
struct GltfTriangles {
    std::vector<Vec3> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;  // corners counter-clockwise
    bool has_colours = false;                             // of vertices, other than white: left out
};

/// The triangles of a primitive given as triangles, a strip or a fan; none of points and lines.
/// `weights` say how far each of its morph targets moves it [1]. Throws InputError.
GltfTriangles read_gltf_primitive(const JsonValue& primitive, std::span<const double> weights,
                                  GltfAccessors& accessors);

}  // namespace patchlight::server
