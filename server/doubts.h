#pragma once

#include "server/job.h"

#include <vector>

namespace patchlight::server {

/// What is allowed but hardly meant: a scene a thousand times too large or small for its unit of
/// length, an angle of view in radians.
std::vector<Finding> doubts(const Job& job);

}  // namespace patchlight::server
