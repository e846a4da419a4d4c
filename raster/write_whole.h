#pragma once

#include <filesystem>
#include <string_view>

namespace patchlight::raster {

/// Puts the bytes into a file of that name, all of them or none: they are written beside it, synced
/// to disk, and take its place by renaming, so that at no time there is half a file. What is
/// there and is no regular file (a pipe, /dev/stdout) is written to as it is. Throws
/// std::system_error with errno and the path; the file that was there is then untouched.
void write_whole(const std::filesystem::path& path, std::string_view bytes);

}  // namespace patchlight::raster
