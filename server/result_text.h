#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace patchlight::server {

/// A result as text for people and programs: indented by 2, lists of numbers on one line each,
/// with a newline at the end.
std::string result_text(const nlohmann::ordered_json& result);

}  // namespace patchlight::server
