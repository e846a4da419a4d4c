#include "solver/rays/cosine_directions.h"

#include "solver/rays/low_discrepancy.h"
#include "solver/rays/wide.h"
#include "solver/scene/polygon.h"

#include <algorithm>
#include <cmath>

namespace patchlight {

namespace {

/// sin(2πx) for |x| <= 1/4, to 6e-8: Taylor's series to x^11.
inline float sine_of_turn(float x) {
    const float t = x * x;
    return x * (6.2831853f +
                t * (-41.341702f +
                     t * (81.605249f + t * (-76.705860f + t * (42.058694f + t * -15.094642f)))));
}

PATCHLIGHT_WIDE void scramble_one(const std::uint32_t* reversed, std::uint32_t seed, Lanes& u) {
    for (std::size_t k = 0; k < ray_batch; ++k) {
        const std::uint32_t x = reverse_bits(scramble_reversed(reversed[k], seed));
        u[k] = static_cast<float>(static_cast<std::int32_t>(x >> 8)) * 0x1p-24f;
    }
}

}  // namespace

void scramble_lanes(const std::array<const std::uint32_t*, 4>& reversed,
                    const std::array<std::uint32_t, 4>& seeds, std::array<Lanes, 4>& u) {
    for (std::size_t d = 0; d < 4; ++d) scramble_one(reversed[d], seeds[d], u[d]);
}

void scramble_lanes(const std::array<const std::uint32_t*, 2>& reversed,
                    const std::array<std::uint32_t, 2>& seeds, std::array<Lanes, 2>& u) {
    for (std::size_t d = 0; d < 2; ++d) scramble_one(reversed[d], seeds[d], u[d]);
}

RayFrame frame_about(const RayPoint& normal) {
    const PlaneFrame frame = frame_of(Vec3::Zero(), normal.cast<double>().normalized());
    return {frame.u.cast<float>(), frame.v.cast<float>(), frame.normal.cast<float>()};
}

RayPoint cosine_direction(const RayFrame& frame, float u, float v) {
    const float turn = v - 0.5f, a = std::abs(turn), folded = a > 0.25f ? 0.5f - a : a;
    const float radius = std::sqrt(u);
    return radius * sine_of_turn(0.25f - a) * frame.tangent +
           radius * sine_of_turn(turn < 0.0f ? -folded : folded) * frame.bitangent +
           std::sqrt(std::max(1e-12f, 1.0f - u)) * frame.normal;
}

PATCHLIGHT_WIDE void cosine_directions(const RayFrame& frame, const Lanes& u, const Lanes& v,
                                       RayBatch& batch) {
    for (std::size_t k = 0; k < ray_batch; ++k) {
        const float turn = v[k] - 0.5f;
        const float a = std::abs(turn);
        const float folded = a > 0.25f ? 0.5f - a : a;
        const float sine = sine_of_turn(turn < 0.0f ? -folded : folded);
        const float cosine = sine_of_turn(0.25f - a);
        const float radius = std::sqrt(u[k]);
        const float x = radius * cosine, y = radius * sine,
                    z = std::sqrt(std::max(1e-12f, 1.0f - u[k]));
        batch.dx[k] = x * frame.tangent.x() + y * frame.bitangent.x() + z * frame.normal.x();
        batch.dy[k] = x * frame.tangent.y() + y * frame.bitangent.y() + z * frame.normal.y();
        batch.dz[k] = x * frame.tangent.z() + y * frame.bitangent.z() + z * frame.normal.z();
    }
}

}  // namespace patchlight
