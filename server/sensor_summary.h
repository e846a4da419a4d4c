#pragma once

#include "server/job.h"
#include "solver/solution.h"

#include <string>

namespace patchlight::server {

/// A line for the first few sensors that stand alone and a line for each of the first few grids,
/// with what is to be found in --sensors beyond them; nothing if there are none. Scalar irradiance.
std::string sensor_lines(const Job& job, const Solution& solution);

}  // namespace patchlight::server
