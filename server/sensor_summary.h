#pragma once

#include "server/job.h"
#include "solver/solution.h"

#include <nlohmann/json.hpp>

#include <string>

namespace patchlight::server {

/// A line for the first few sensors that stand alone and a line for each of the first few grids,
/// with what is to be found in --sensors beyond them; nothing if there are none. Scalar irradiance.
/// `grids` as they stand in the result; if not given, as if none of their points was left out.
std::string sensor_lines(const Job& job, const Solution& solution,
                         const nlohmann::ordered_json& grids);
std::string sensor_lines(const Job& job, const Solution& solution);

}  // namespace patchlight::server
