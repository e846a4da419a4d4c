#pragma once

#include "server/job.h"

#include <nlohmann/json.hpp>

#include <string_view>

namespace patchlight::server {

/// Reads a scene document. Strict: whatever is not understood throws InputError with the JSON
/// pointer of the culprit.
Job read_scene(const nlohmann::json& document);

/// The same from bytes. Throws JsonError if they are no JSON.
Job read_scene_text(std::string_view bytes);

}  // namespace patchlight::server
