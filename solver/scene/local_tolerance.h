#pragma once

#include "solver/scene/scene.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace patchlight {

using FrameIndex = std::uint8_t;
constexpr std::size_t most_frames = 64;

/// Where coordinates are measured from. Surfaces that lie near one another share a frame; those
/// far away for their size have another, for floats measured from there would not tell them apart.
struct LocalFrame {
    Eigen::AlignedBox3d box;  // round the surfaces that it is made for [m]
    Vec3 origin() const { return box.center(); }
    double radius() const { return 0.5 * box.sizes().maxCoeff(); }  // [m]
    double size() const { return box.diagonal().norm(); }           // [m]
};

/// What counts as touching, coplanar or coincident: the larger of 1e-6 of the smaller surface's
/// size and four steps of float32 at the place, measured from the origin of its frame; never a
/// share of the scene. The one place that tells: a polygon far away changes nothing near.
class LocalTolerance {
  public:
    explicit LocalTolerance(const Scene& scene);

    /// Of two surfaces that meet [m].
    double between(SurfaceIndex s, SurfaceIndex t) const {
        return std::max(share * std::min(sizes_[s], sizes_[t]),
                        steps * std::max(steps_[s], steps_[t]));
    }
    /// Of one surface and whatever meets it: no pair it belongs to has a larger one, unless the
    /// other surface is known less well [m].
    double at(SurfaceIndex s) const { return std::max(share * sizes_[s], steps * steps_[s]); }
    /// Of a point that belongs to no surface: of the largest surface its frame may have [m].
    double at_point(FrameIndex f) const;
    /// Corners closer than this are one, to what double leaves of coordinates in a frame [m].
    double same_point(FrameIndex f) const;
    /// A step of float32 in the frame of surface s, or where that reaches out of it, there [m].
    double step(SurfaceIndex s) const { return steps_[s]; }
    /// What arithmetic in double leaves of the place of surface s, as its coordinates are given,
    /// and never less than `of_frame` times the size of its frame [m].
    double rounding(SurfaceIndex s, double of_frame) const {
        return std::max(of_frame * frames_[frame_of_[s]].size(), roundings_[s]);
    }

    const std::vector<LocalFrame>& frames() const { return frames_; }
    FrameIndex frame_of(SurfaceIndex s) const { return frame_of_[s]; }
    const LocalFrame& frame(SurfaceIndex s) const { return frames_[frame_of_[s]]; }
    /// The frame in which coordinates of p are known best.
    FrameIndex frame_at(const Vec3& p) const;

  private:
    static constexpr double share = 1e-6, steps = 4.0;

    std::vector<LocalFrame> frames_;
    std::vector<FrameIndex> frame_of_;
    std::vector<double> sizes_, steps_, roundings_;  // per surface [m]
};

}  // namespace patchlight
