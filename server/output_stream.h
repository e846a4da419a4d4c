#pragma once

#include "server/text_sink.h"

#include <functional>
#include <string>

namespace patchlight::server {

/// The name that means standard output.
inline constexpr const char* to_standard_output = "-";

/// Has `write` write into a file of that name, which is there whole or, if something is thrown on
/// the way, not at all (see raster/whole_file.h); "-" is standard output. Throws what `write`
/// throws, and std::system_error naming the file.
void write_output(const std::string& path, const std::function<void(const TextSink&)>& write);

}  // namespace patchlight::server
