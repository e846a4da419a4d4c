#pragma once

namespace patchlight::server {

/// Of the program, such as "0.1.0".
const char* program_version();

}  // namespace patchlight::server
