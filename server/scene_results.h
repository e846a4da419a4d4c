#pragma once

#include "solver/solution.h"

#include <nlohmann/json.hpp>

#include <vector>

namespace patchlight::server {

// What a result says of each thing in the scene.

nlohmann::ordered_json channels(const Rgb& quantity);

/// The materials as they were understood, by name.
nlohmann::ordered_json materials_block(const Scene& scene);

nlohmann::ordered_json object_results(const Scene& scene, const Solution& solution);
nlohmann::ordered_json sensor_results(const Scene& scene, const Solution& solution);

/// Of scalar illuminance over each grid; `uniformity` is min / mean, absent in the dark. `left_out`
/// counts the points that are misplaced, of which the rest says nothing.
nlohmann::ordered_json grid_results(const Scene& scene, const Solution& solution);

nlohmann::ordered_json finding_list(const std::vector<Finding>& findings);

}  // namespace patchlight::server
