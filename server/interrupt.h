#pragma once

namespace patchlight::server {

/// From now on SIGINT and SIGTERM are taken as a wish to stop, the first time; the second kills.
void catch_interrupts();

bool is_interrupted();

}  // namespace patchlight::server
