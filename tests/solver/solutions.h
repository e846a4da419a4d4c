#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace patchlight {

/// A case of tests/physics/data/solutions.json, such as "s-d15".
nlohmann::json solution_case(const std::string& id);

}  // namespace patchlight
