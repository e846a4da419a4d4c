#pragma once

#include "tests/stability/column.h"
#include "tests/stability/judgement.h"

#include <functional>
#include <vector>

namespace patchlight::stability {

using Corners = std::vector<Vec3>;

/// A receiver, a lamp and blockers between. All are black, but that a receiver sends back half of
/// its light where that is what an accuracy refers to.
struct LitPair {
    Corners receiver, lamp;
    std::vector<Corners> blockers{};
};

/// origin, origin + u, origin + u + v, origin + v; its front is where u × v points.
Corners parallelogram(const Vec3& origin, const Vec3& u, const Vec3& v);

/// Squares of edge `low` at z = 0 and `high` at z = `distance` that face each other, centred.
LitPair facing_squares(double low, double high, double distance);

Scene scene_of(const LitPair& pair, double reflectance);

/// The form factor from receiver to lamp, told by the light on the receiver [1].
double factor(const LitPair& pair, const Column& column, const HandSet& by_hand,
              std::uint64_t seed = 1);

/// Relative error of that, root mean square over seeds; a method without chance is asked once.
double relative_error(const LitPair& pair, double exact, const Column& column,
                      const HandSet& by_hand, int seeds = 4);

/// Relative scatter of independent counts where a share `factor` of n rays or cells hits.
double binomial(double factor, int n);

}  // namespace patchlight::stability
