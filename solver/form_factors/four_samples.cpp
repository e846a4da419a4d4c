#include "solver/form_factors/four_samples.h"

#include "solver/rays/wide.h"

#include <cstring>

namespace patchlight {

namespace {

using Floats = float __attribute__((vector_size(four * sizeof(float))));
using Words = std::uint32_t __attribute__((vector_size(four * sizeof(std::uint32_t))));
using Ints = std::int32_t __attribute__((vector_size(four * sizeof(std::int32_t))));

struct Points {
    Floats x, y, z;
};

inline Floats coordinate(const std::uint32_t* reversed, std::uint32_t seed) {
    Words words;
    std::memcpy(&words, reversed, sizeof words);
    const Words x = reverse_bits(scramble_reversed(words, Words{} + seed)) >> 8;
    Ints signed_x;
    std::memcpy(&signed_x, &x, sizeof x);
    return __builtin_convertvector(signed_x, Floats) * 0x1p-24f;
}

inline Points points_on(const PatchSampler& s, const RayPoint& above, Floats u, Floats v) {
    if (s.parallelogram) {
        const float width = 1.0f - 2.0f * s.margin;
        const Floats a = s.margin + width * u, b = s.margin + width * v;
        const RayPoint c = s.corner + above;
        return {c.x() + a * s.first_edge.x() + b * s.second_edge.x(),
                c.y() + a * s.first_edge.y() + b * s.second_edge.y(),
                c.z() + a * s.first_edge.z() + b * s.second_edge.z()};
    }
    Points points{};
    for (int k = 0; k < four; ++k) {
        const RayPoint p = s.at(u[k], v[k]) + above;
        points.x[k] = p.x(), points.y[k] = p.y(), points.z[k] = p.z();
    }
    return points;
}

inline Floats positive(Floats x) { return x > 0.0f ? x : Floats{}; }

struct Lanes {  // where the results go
    float *ox, *oy, *oz, *dx, *dy, *dz, *ex, *ey, *ez, *weight;
};

PATCHLIGHT_WIDE void fill(const PairEnds& ends, const std::array<const std::uint32_t*, 4>& reversed,
                          const Lanes& lanes) {
    std::array<Floats, 4> u;
    for (std::size_t d = 0; d < 4; ++d) u[d] = coordinate(reversed[d], ends.seeds[d]);
    const Points x = points_on(ends.from, ends.above_from, u[0], u[1]);
    const Points y = points_on(ends.to, ends.above_to, u[2], u[3]);
    const RayPoint& shift = ends.shift;
    const Floats dx = y.x + shift.x() - x.x, dy = y.y + shift.y() - x.y, dz = y.z + shift.z() - x.z;
    const Floats squared = dx * dx + dy * dy + dz * dz;
    const RayPoint &n = ends.from.normal, &m = ends.to.normal;
    const Floats leaving = positive(dx * n.x() + dy * n.y() + dz * n.z());
    const Floats arriving = positive(-(dx * m.x() + dy * m.y() + dz * m.z()));
    const Floats weight = leaving / squared * (arriving / squared);
    std::memcpy(lanes.ox, &x.x, sizeof(Floats)), std::memcpy(lanes.oy, &x.y, sizeof(Floats)),
        std::memcpy(lanes.oz, &x.z, sizeof(Floats));
    std::memcpy(lanes.dx, &dx, sizeof(Floats)), std::memcpy(lanes.dy, &dy, sizeof(Floats)),
        std::memcpy(lanes.dz, &dz, sizeof(Floats));
    std::memcpy(lanes.weight, &weight, sizeof(Floats));
    if (ends.from.frame == ends.to.frame) return;
    std::memcpy(lanes.ex, &y.x, sizeof(Floats)), std::memcpy(lanes.ey, &y.y, sizeof(Floats)),
        std::memcpy(lanes.ez, &y.z, sizeof(Floats));
}

}  // namespace

void make_four_samples(const PairEnds& ends, const SobolPoints& points, int first, int lane,
                       RayBatch& batch, std::array<float, ray_batch>& weights) {
    std::array<const std::uint32_t*, 4> reversed;
    for (std::size_t d = 0; d < 4; ++d) reversed[d] = points.reversed(d) + first;
    fill(ends, reversed,
         {&batch.ox[lane], &batch.oy[lane], &batch.oz[lane], &batch.dx[lane], &batch.dy[lane],
          &batch.dz[lane], &batch.ex[lane], &batch.ey[lane], &batch.ez[lane], &weights[lane]});
    for (int k = lane; k < lane + four; ++k) {
        batch.frame[k] = ends.from.frame;
        batch.end_frame[k] = ends.to.frame;
    }
}

}  // namespace patchlight
