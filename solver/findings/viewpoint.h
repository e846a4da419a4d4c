#pragma once

#include "solver/scene/light.h"

#include <string>

namespace patchlight {

/// A point from which pictures are taken.
struct Viewpoint {
    std::string name;
    Vec3 position = Vec3::Zero();  // [m]
};

}  // namespace patchlight
