#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace patchlight::server {

/// The bytes of a regular file of at most 512 MiB. Throws InputError at `shown`, which is how
/// messages call it.
std::string read_file_bytes(const std::filesystem::path& path, const std::string& shown);

/// The first 64 KiB of a regular file, or as many as there are; none if it cannot be read.
std::string first_bytes(const std::filesystem::path& path);

/// The file that another one refers to, if it lies in that one's directory or below; a link counts
/// as what it points to. Empty if it lies elsewhere. It need not be there.
std::optional<std::filesystem::path> file_beside(const std::filesystem::path& file,
                                                 const std::string& reference);

}  // namespace patchlight::server
