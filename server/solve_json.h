#pragma once

#include "server/json_value.h"
#include "solver/settings.h"

#include <nlohmann/json.hpp>

#include <string>

namespace patchlight::server {

/// The block `solve` of a scene, or what the command line puts over it: what it does not name
/// stays as it is. `metres` is the length of one unit of the scene [m].
void read_solve(const JsonValue& block, double metres, SolveSettings& settings);

/// What was asked for and what was chosen, as a block `solve` with lengths in metres.
nlohmann::ordered_json solve_block(const SolveSettings& settings);

std::string name_of(Method method);
std::string name_of(Engine engine);

}  // namespace patchlight::server
