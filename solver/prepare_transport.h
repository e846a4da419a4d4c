#pragma once

#include "solver/accuracy/coarse_transport.h"
#include "solver/form_factors/form_factor_engine.h"
#include "solver/solve_stage.h"

#include <functional>
#include <memory>
#include <vector>

namespace patchlight {

/// What carries light between patches, and what of it meets no front.
struct PreparedTransport {
    std::unique_ptr<CoarseTransport> transport;  // none: the work was stopped
    std::vector<double> backs, escaped;          // shares of each patch's light [1]
    std::unique_ptr<FormFactorEngine> engine;    // that `transport` may ask
};

/// As the settings of the stage's solution say. `go_on` is asked while what it needs is made ready.
PreparedTransport prepare_transport(const SolveStage& stage, std::uint64_t seed,
                                    const std::function<bool()>& go_on);

}  // namespace patchlight
