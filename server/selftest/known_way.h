#pragma once

#include "solver/settings.h"
#include "solver/solution.h"

#include <string>
#include <vector>

namespace patchlight::server {

/// What a stochastic answer may deviate, in standard errors: false alarm 1 in 16 000 for each; the
/// seed is fixed, so a build gives one and the same answer every time.
inline constexpr double deviations = 4.0;

/// Relative error of an analytic factor that nothing blocks: Gauss quadrature with some points an
/// edge, and factors stored as floats [1].
inline constexpr double quadrature = 1e-6;

/// Engine and solver set by hand.
struct KnownWay {
    Engine engine = Engine::analytic;
    Method method = Method::gauss_seidel;
};

/// All three engines times both solvers.
std::vector<KnownWay> every_way();

/// `rays` per patch, or hemicubes with so many cells in their top face; solved to 1e-8.
SolveSettings settings_of(const KnownWay& way, double patch_size, int rays);

/// A solve to an accuracy, and nothing else.
SolveSettings to_accuracy(double accuracy);

/// Such as "ray-cast shooting", or "accuracy 0.01".
std::string method_text(const SolveSettings& settings);

/// What a factor between two large surfaces may be off, on so many patches each: of analytic
/// factors by quadrature; of ray-cast ones by `deviations` binomial standard errors; of hemicubes
/// by what they report: proximity, the same on all patches, twice (a share that is given to one is
/// taken from another), and aliasing and visibility, independent from patch to patch [1].
double factor_bound(const Solution& solution, double factor, double patches);

}  // namespace patchlight::server
