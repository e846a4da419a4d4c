#pragma once

namespace patchlight::server {

/// The program: reads its arguments, does what they ask and returns the exit code. Results go to
/// standard output, everything else to standard error.
int run_command_line(int count, const char* const* arguments);

}  // namespace patchlight::server
