#pragma once

#include "solver/findings/flaw_search.h"
#include "solver/settings.h"

#include <vector>

namespace patchlight {

/// "small-emitter": lamps that so few samples connect with the patches they light that their light
/// is noise there, or missing: fewer than 10 for half of it. That is so where form factors are
/// counted, by rays or by cells of hemicubes, and the light shown comes of them: not with analytic
/// ones, nor where an accuracy is asked for, for then lamps are gathered from one by one.
/// `planned`: with every choice made. One finding names them all.
std::vector<Finding> find_small_emitters(const FlawSearch& search, const SolveSettings& planned);

}  // namespace patchlight
