#pragma once

#include "solver/findings/assemblies.h"
#include "solver/findings/flaw_search.h"
#include "solver/findings/surface_tree.h"

#include <optional>
#include <vector>

namespace patchlight {

/// A body that touches nothing and hangs a small way off another.
struct Floating {
    SurfaceIndex body = 0;       // of its surfaces, the one that comes nearest
    SurfaceIndex support = 0;    // that it nearly touches
    std::uint32_t assembly = 0;  // of the body
    Vec3 place = Vec3::Zero();   // of the body, where it is nearest [m]
    double distance = 0.0;       // [m]
};

/// Assemblies smaller than half the scene that come nearer to another than a hundredth of their own
/// size and yet do not touch it: chairs above a floor, vases above a table. What is flat
/// is none, nor is what is enclosed by backs, such as the inner shell of a bowl.
std::vector<Floating> find_floating(const FlawSearch& search, const Assemblies& assemblies,
                                    const SurfaceTree& tree);

/// "floating-object": one for each pair of objects.
std::vector<Finding> floating_findings(const FlawSearch& search,
                                       const std::vector<Floating>& floating);

}  // namespace patchlight
