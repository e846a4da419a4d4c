#pragma once

#include "server/job.h"
#include "server/json_value.h"

#include <nlohmann/json.hpp>

#include <vector>

namespace patchlight::server {

constexpr int most_pixels_along_an_edge = 16384;

/// The block `cameras` of a scene. `metres` is the length of one unit of the scene [m].
/// Throws InputErrors.
std::vector<NamedCamera> read_cameras(const JsonValue& list, double metres);

/// A camera that sees the whole scene.
NamedCamera framing_camera(const Scene& scene, int width, int height);

/// As it would stand in a scene whose unit of length is the metre.
nlohmann::ordered_json camera_block(const NamedCamera& camera);

}  // namespace patchlight::server
