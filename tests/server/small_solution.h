#pragma once

#include "server/job.h"
#include "solver/solution.h"

namespace patchlight::server {

/// A lamp of 2 m² (exitance 100, reflectance 0.5) facing a floor of 1 m² (reflectance 0.4), with a
/// grid of 2 x 1 sensors. One patch each.
Job small_job();

/// Numbers made up for it, all of them finite and none of them 0.
Solution small_solution();

}  // namespace patchlight::server
