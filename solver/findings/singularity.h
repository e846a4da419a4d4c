#pragma once

#include "solver/findings/flaw_search.h"

#include <vector>

namespace patchlight {

/// "near-singular": objects from which light goes on and on, because all that it meets reflects
/// nearly all of it and next to nothing escapes: the share q of light that is left after a
/// reflection, mean over its way, is 0.985 or more in a channel. Errors grow up to 1 / (1 - q)
/// times. One finding names them all.
std::vector<Finding> find_singularity(const FlawSearch& search);

}  // namespace patchlight
