#include "solver/scene/local_tolerance.h"

#include "solver/scene/local_frames.h"

#include <limits>

namespace patchlight {

namespace {
constexpr double float_step = 0x1p-23;    // of a coordinate, at most [1]
constexpr double same_corner = 1e-9;      // of a frame's size [1]
constexpr double double_steps = 0x1p-48;  // sixteen steps of double: what a few sums leave [1]
}  // namespace

LocalTolerance::LocalTolerance(const Scene& scene) {
    const std::vector<Box3> boxes = surface_boxes(scene);
    LocalFrames found = find_local_frames(scene, boxes);
    frames_ = std::move(found.frames);
    frame_of_ = std::move(found.of_surface);
    for (SurfaceIndex s = 0; s < boxes.size(); ++s) {
        const auto farthest = [&](const Vec3& from) {
            return std::max((boxes[s].min() - from).cwiseAbs().maxCoeff(),
                            (boxes[s].max() - from).cwiseAbs().maxCoeff());
        };
        sizes_.push_back(boxes[s].diagonal().norm());
        steps_.push_back(float_step * std::max(farthest(frame(s).origin()), frame(s).radius()));
        roundings_.push_back(double_steps * farthest(Vec3::Zero()));
    }
}

double LocalTolerance::at_point(FrameIndex f) const {
    const LocalFrame& frame = frames_[f];
    return frame.box.isEmpty()
               ? 0.0
               : std::max(share * frame.size(), steps * float_step * frame.radius());
}

double LocalTolerance::same_point(FrameIndex f) const {
    const LocalFrame& frame = frames_[f];
    if (frame.box.isEmpty()) return 0.0;
    return std::max(same_corner * frame.size(),
                    double_steps * std::max(frame.box.min().cwiseAbs().maxCoeff(),
                                            frame.box.max().cwiseAbs().maxCoeff()));
}

FrameIndex LocalTolerance::frame_at(const Vec3& p) const {
    FrameIndex best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t f = 0; f < frames_.size(); ++f) {
        const double away = std::max((p - frames_[f].origin()).norm(), frames_[f].radius());
        if (away >= least) continue;
        least = away;
        best = static_cast<FrameIndex>(f);
    }
    return best;
}

}  // namespace patchlight
