#pragma once

#include <string>

namespace patchlight::server {

/// Asks /healthz. Why the server counts as dead, or nothing if it is alive.
std::string health_problem(const std::string& host, int port);

}  // namespace patchlight::server
