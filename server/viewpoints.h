#pragma once

#include "server/job.h"
#include "solver/findings/viewpoint.h"

#include <vector>

namespace patchlight::server {

/// Where the cameras stand that the author of a job has placed.
std::vector<Viewpoint> viewpoints(const Job& job);

}  // namespace patchlight::server
