#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace patchlight::server {

/// Throws InputError at `shown` if the bytes are text in UTF-16 or UTF-32, by their first ones.
void refuse_wide_text(std::string_view bytes, const std::string& shown);

/// A text file of at most 512 MiB, with '?' for what is not UTF-8. Throws InputError at `shown`.
std::string read_text_file(const std::filesystem::path& path, const std::string& shown);

}  // namespace patchlight::server
