#pragma once

#include "server/trace/trace_files.h"

#include <string>

namespace patchlight::server {

/// The part of the page on what one patch sees: its row of form factors, and the hemicube.
std::string hemicube_section(const Trace& trace);

}  // namespace patchlight::server
