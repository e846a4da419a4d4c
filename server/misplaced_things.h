#pragma once

#include "server/job.h"
#include "solver/findings/misplaced.h"

namespace patchlight::server {

/// The sensors of a job, and the cameras its author has placed, that lie in a solid or outside the
/// room.
Misplaced find_misplaced(const Job& job);

}  // namespace patchlight::server
