#include "tests/stability/furnace.h"

#include "tests/stability/lit_pair.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace patchlight::stability {

double furnace_error(const Scene& scene, const Solution& solution, double exact) {
    double worst = 0.0;
    for (std::size_t o = 0; o < scene.objects.size(); ++o) {
        if (!(solution.objects[o].area > 0.0)) continue;
        const double off = std::abs(solution.objects[o].radiosity[0] / exact - 1.0);
        worst = std::isfinite(off) ? std::max(worst, off) : std::numeric_limits<double>::infinity();
    }
    return worst;
}

double furnace_error(const Scene& scene, const Column& column) {
    return furnace_error(scene, solve(scene, column), 2.0);
}

Excuse one_ended_rows(const Column& column, double smallest, int rays) {
    if (!column.shoots()) return {};
    return {std::max(2.0 * binomial(smallest, rays), 0.05),
            "shooting takes the shooter's row as it comes: a patch receives what happens to meet "
            "it, 1/√(nF) of n rays or cells"};
}

}  // namespace patchlight::stability
