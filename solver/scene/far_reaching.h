#pragma once

#include "solver/scene/scene.h"

namespace patchlight {

/// Cuts polygons that reach far beyond the frame of something small beside them, such as a ground
/// of 200 km under a room: into a square about the small one and rings of four trapezoids about
/// that, each four times as wide as what it surrounds, so that every piece is known as well as what
/// is near it. Pieces keep the polygon's face and object. Patches of what is far away are allowed
/// to be so much coarser that what is near has about as many as it would have alone. Scenes of one
/// frame are left as they are.
void settle_far_geometry(Scene& scene);

}  // namespace patchlight
