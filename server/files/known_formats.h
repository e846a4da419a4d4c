#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace patchlight::server {

/// What a file of a format that is not read is, and what to do: "is a PLY mesh, which is not read;
/// convert it to glTF, OBJ or STL". By its first bytes; empty if they are of no format known here.
std::string foreign_content(std::string_view bytes);

/// The same by the ending of its name.
std::string foreign_name(const std::filesystem::path& path);

}  // namespace patchlight::server
