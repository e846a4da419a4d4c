#pragma once

#include "tests/stability/column.h"
#include "tests/stability/judgement.h"

namespace patchlight::stability {

/// Relative, of object means: rows closed in float, 6e-8 over 1 − ρ, and the solver's 1e-6. A solve
/// to an accuracy of 2 % keeps this too, as what it corrects for is the same everywhere.
constexpr double furnace_closure = 1e-4;

/// Where everything reflects ρ and gives off E, B = E / (1 − ρ): the largest relative deviation of
/// an object's mean radiosity, infinite if one is no number.
double furnace_error(const Scene& scene, const Solution& solution, double exact);
/// The same of a solve of a scene in which ρ = 0.5 and E = 1.
double furnace_error(const Scene& scene, const Column& column);

/// Shooting uses the row of one end as it comes: where rays or cells count, or tell what is
/// blocked, a patch receives what happens to meet it. `smallest`: share of a row's light that falls
/// on the smallest object.
Excuse one_ended_rows(const Column& column, double smallest, int rays = HandSet{}.rays);

}  // namespace patchlight::stability
