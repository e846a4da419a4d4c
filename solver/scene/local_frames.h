#pragma once

#include "solver/scene/local_tolerance.h"

#include <vector>

namespace patchlight {

using Box3 = Eigen::AlignedBox3d;

struct LocalFrames {
    std::vector<LocalFrame> frames;
    std::vector<FrameIndex> of_surface;
};

/// Frames for a scene: one, unless there are objects so much smaller than their distance from its
/// middle that steps of float32 there are large for them. Those are taken together where they lie
/// near one another, by halving along the three axes what is too far apart. A frame is also that
/// of larger surfaces which reach into its neighbourhood.
LocalFrames find_local_frames(const Scene& scene, const std::vector<Box3>& boxes);

/// Surfaces' boxes.
std::vector<Box3> surface_boxes(const Scene& scene);

}  // namespace patchlight
