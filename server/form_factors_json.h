#pragma once

#include "solver/solution.h"

#include <nlohmann/json.hpp>

namespace patchlight::server {

/// What is known of a matrix of form factors: row sums, closure, reciprocity, before and after
/// repair.
nlohmann::ordered_json form_factors_block(const FormFactorReport& form_factors);

}  // namespace patchlight::server
