#pragma once

#include "server/job.h"
#include "server/run_report.h"
#include "solver/solution.h"

#include <nlohmann/json.hpp>

#include <string>

namespace patchlight::server {

/// The result document, `result_hash` included. All in SI; a quantity that is not known is not
/// there. Throws std::logic_error rather than write a number that is not finite.
nlohmann::ordered_json result_json(const Job& job, const Solution& solution,
                                   const RunReport& report);

/// SHA-256 of the result without what differs from run to run or from machine to machine
/// (`seconds` of the stages and of each iteration, `threads`, `peak_memory_bytes`, `memory_limit`,
/// `result_hash`), followed by the vertex radiosities.
std::string result_hash(nlohmann::ordered_json result, const DisplayMesh& display);

/// Whether the solver was reached before the work was stopped: else energy and form factors are
/// not known.
bool is_solved(const Solution& solution);

std::string name_of(Status status);

}  // namespace patchlight::server
