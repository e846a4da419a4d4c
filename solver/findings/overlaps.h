#pragma once

#include "solver/scene/coplanar.h"
#include "solver/scene/finding.h"

#include <vector>

namespace patchlight {

/// One finding for each pair of objects of which one covers the other and that is not what is
/// meant: where it covers what gives off light, or all of an object, and where a face is given
/// twice. A rug on a floor and a lamp on a ceiling are nothing to tell of.
std::vector<Finding> overlap_findings(const Scene& scene, const CoplanarOverlaps& overlaps);

}  // namespace patchlight
