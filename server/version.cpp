#include "server/version.h"

namespace patchlight::server {

const char* program_version() { return PATCHLIGHT_VERSION; }

}  // namespace patchlight::server
