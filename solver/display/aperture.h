#pragma once

#include "solver/rays/ray_scene.h"

namespace patchlight {

/// A parallelogram in a gap between surfaces, through which a lamp lights what lies beyond: a slit,
/// a hole, a gap between louvres. All in ray space.
struct Aperture {
    RayPoint corner, first_edge, second_edge;
    RayPoint normal;  // unit, either way
    float area = 0.0f;
    RayPoint first_of, second_of;  // (p - corner)·x: coordinates along the edges [1]
    /// So little of a lamp is seen through it that samples of the lamp hardly find it, or it is all
    /// that a sun lights; else it makes spots that vertices may miss, and no more.
    bool hides_lamps = true;

    RayPoint at(float u, float v) const { return corner + u * first_edge + v * second_edge; }
    struct Pick {
        RayPoint point;
        float area = 0.0f;  // it stands for: one over the density
    };
    /// (u, v) in [0, 1)² to a point, along the longer edge at angles all alike as seen from
    /// `origin`: a slit is near to few of its points (Kulla & Fajardo, "Importance Sampling
    /// Techniques for Path Tracing in Participating Media", 2012).
    Pick pick_from(const RayPoint& origin, float u, float v) const;
    /// Whether the segment from `origin` along `ray` crosses it.
    bool crosses(const RayPoint& origin, const RayPoint& ray) const {
        const float along = ray.dot(normal), above = (corner - origin).dot(normal);
        if (!(above * along > 0.0f) || std::abs(above) >= std::abs(along)) return false;
        const RayPoint p = origin + (above / along) * ray - corner;
        const float u = p.dot(first_of), v = p.dot(second_of);
        return u >= 0.0f && u < 1.0f && v >= 0.0f && v < 1.0f;
    }
};

/// From a corner and two edges that are at right angles.
Aperture make_aperture(const RayPoint& corner, const RayPoint& first_edge,
                       const RayPoint& second_edge);

}  // namespace patchlight
