#pragma once

#include "server/selftest/known_scene.h"

namespace patchlight::server {

/// The Cornell box as it was measured (Cornell University Program of Computer Graphics, "Cornell
/// Box Data", 1998), open in front, with red, green and white of one value a channel; in metres.
KnownScene cornell_box();

}  // namespace patchlight::server
