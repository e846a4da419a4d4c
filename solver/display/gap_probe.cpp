#include "solver/display/gap_probe.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace patchlight {

namespace {

constexpr float least = 3e-3f;   // of the widest gap: narrower ones let hardly any light through
constexpr float longest = 2.0f;  // as wide as all there is
constexpr int halvings = 10;
constexpr float slack = 0.02f;   // of a gap's width, on each side
constexpr int centrings = 2;     // of centring
constexpr float inside = 0.95f;  // of the reach
constexpr float depth = 2.0f;    // of what bounds a gap, over its width [1]

}  // namespace

/// What bounds a gap lies about as near its plane as it is wide: what is met farther off is what
/// the light falls on.
float GapProbe::half_at(float offset) const {
    return std::min(inside * reach, depth * offset + least * widest);
}

bool GapProbe::may_be_gap(const RayPoint& point, const Axes& axes) const {
    RayBatch batch;
    const std::array<RayPoint, 4> ways{axes.first, -axes.first, axes.second, -axes.second};
    for (std::size_t k = 0; k < ray_batch; ++k) {
        const float offset = widest * std::pow(0.25f, static_cast<float>(k % 4));
        const float half = half_at(offset);
        const RayPoint from = point + offset * ways[k / 4] - half * direction,
                       ray = 2.0f * half * direction;
        batch.ox[k] = from.x(), batch.oy[k] = from.y(), batch.oz[k] = from.z();
        batch.dx[k] = ray.x(), batch.dy[k] = ray.y(), batch.dz[k] = ray.z();
    }
    const std::uint32_t blocked = rays.blocked(batch, ray_batch);
    const auto any = [&](unsigned way) { return ((blocked >> (4 * way)) & 15u) != 0; };
    return (any(0) && any(1)) || (any(2) && any(3));
}

bool GapProbe::is_blocked(const RayPoint& point, float half) const {
    RayBatch batch;
    const RayPoint from = point - half * direction, ray = 2.0f * half * direction;
    batch.ox[0] = from.x(), batch.oy[0] = from.y(), batch.oz[0] = from.z();
    batch.dx[0] = ray.x(), batch.dy[0] = ray.y(), batch.dz[0] = ray.z();
    return (rays.blocked(batch, 1) & 1u) != 0;
}

bool GapProbe::is_clear(const RayPoint& point, float half) const {
    if (is_blocked(point, half)) return false;
    RayBatch batch;
    LandingBatch landed;
    batch.ox[0] = point.x(), batch.oy[0] = point.y(), batch.oz[0] = point.z();
    batch.dx[0] = direction.x(), batch.dy[0] = direction.y(), batch.dz[0] = direction.z();
    rays.land(batch, 1, landed);
    return landed.landing[0] == Landing::front;
}

/// How far lines are clear from a clear point, `most` if it is as far; lines are as long as what
/// bounds a gap of that width needs, where it is known: of a slit longer ones would end at what it
/// ends at, slanting.
GapProbe::Reach GapProbe::clear_along(const RayPoint& point, const RayPoint& unit, float first,
                                      float most, float width) const {
    float clear = 0.0f, next = first;
    while (is_clear(point + next * unit, half_at(std::min(next, width)))) {
        clear = next;
        if (next >= most) return {most, false};
        next = std::min(2.0f * next, most);
    }
    const float fixed = half_at(std::min(next, width));
    float beyond = next;
    for (int k = 0; k < halvings; ++k) {
        const float middle = 0.5f * (clear + beyond);
        (is_clear(point + middle * unit, fixed) ? clear : beyond) = middle;
    }
    return {beyond, is_blocked(point + beyond * unit, fixed)};
}

std::optional<GapProbe::Axes> GapProbe::axes(const RayPoint& outward, const RayPoint& along,
                                             const RayPoint& normal) const {
    Axes axes{outward, along.normalized()};
    if (std::abs(direction.dot(normal)) >= grazing) return axes;
    axes.second -= axes.second.dot(direction) * direction;
    if (!(axes.second.norm() > grazing)) return std::nullopt;
    axes.second.normalize();
    axes.first = axes.second.cross(direction);
    return axes;
}

std::optional<Aperture> GapProbe::find(const RayPoint& point, const RayPoint& outward,
                                       const RayPoint& along, const RayPoint& normal) const {
    const std::optional<Axes> found = axes(outward, along, normal);
    if (!found || !may_be_gap(point, *found)) return std::nullopt;
    const auto& [first, second] = *found;
    RayPoint centre = point;
    float width = 0.0f, length = 0.0f;
    for (int round = 0; round < centrings; ++round) {
        if (!is_clear(centre, least * widest)) return std::nullopt;
        const float start = std::max(least * widest, 0.1f * width);
        const Reach ahead = clear_along(centre, first, start, 2.0f * widest, longest),
                    back = clear_along(centre, -first, start, 2.0f * widest, longest);
        centre += 0.5f * (ahead.clear - back.clear) * first;
        width = ahead.clear + back.clear;
        if (!is_clear(centre, least * widest)) return std::nullopt;
        const float step = std::max(start, 0.5f * width);
        const Reach left = clear_along(centre, second, step, longest, width),
                    right = clear_along(centre, -second, step, longest, width);
        centre += 0.5f * (left.clear - right.clear) * second;
        length = left.clear + right.clear;
        const bool narrow = width <= widest && ahead.ends && back.ends,
                   narrow_across = length <= widest && left.ends && right.ends;
        if (!narrow && !narrow_across) return std::nullopt;
    }
    if (std::min(width, length) < least * widest) return std::nullopt;
    const RayPoint a = (1.0f + 2.0f * slack) * width * first,
                   b = length * second + 2.0f * slack * width * second;
    return make_aperture(centre - 0.5f * (a + b), a, b);
}

}  // namespace patchlight
