#pragma once

#include "server/job.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string_view>

namespace patchlight::server {

/// Where a scene comes from.
struct SceneSource {
    /// In which `file` of an object is looked for: the directory of the scene's own file. Empty, as
    /// for a scene that came over the network: such objects are refused.
    std::optional<std::filesystem::path> directory;
};

/// Reads a scene document. Strict: whatever is not understood throws InputErrors with the JSON
/// pointers of the culprits, up to 20 of them.
Job read_scene(const nlohmann::json& document, const SceneSource& source = {});

/// The same from bytes. Throws JsonError if they are no JSON.
Job read_scene_text(std::string_view bytes, const SceneSource& source = {});

}  // namespace patchlight::server
