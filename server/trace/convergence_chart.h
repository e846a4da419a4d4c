#pragma once

#include "server/text_sink.h"
#include "solver/solution.h"

#include <span>
#include <string>

namespace patchlight::server {

/// iteration,seconds,residual,unshot: a row for each recorded step; unshot is empty but for
/// shooting.
void write_convergence_csv(std::span<const ConvergenceStep> steps, const TextSink& sink);

/// The residual and, for shooting, the unshot share over the steps, in decades: an SVG picture of
/// its own.
std::string convergence_svg(std::span<const ConvergenceStep> steps, const std::string& step_name);

}  // namespace patchlight::server
