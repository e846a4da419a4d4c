#pragma once

#include "solver/scene/finding.h"

#include <vector>

namespace patchlight {

/// At most 5 findings of a kind: the others are merged into one more that counts them.
std::vector<Finding> merge_alike(std::vector<Finding> findings);

}  // namespace patchlight
