#pragma once

#include "server/trace/trace_files.h"

#include <string>

namespace patchlight::server {

/// The page that shows the files of a trace and says what they are: HTML that needs nothing but the
/// files beside it.
std::string trace_page(const Trace& trace);

}  // namespace patchlight::server
