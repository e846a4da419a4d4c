#include "solver/form_factors/pair_visibility.h"

#include "solver/form_factors/four_samples.h"

#include <algorithm>

namespace patchlight {

namespace {
constexpr std::uint32_t queries_between_looks = 64;  // at the clock
}

struct PairVisibility::Packet {
    RayBatch segments;
    std::array<float, ray_batch> weight;
    std::array<std::uint32_t, ray_batch / four> query;  // of each four lanes
    int size = 0;
};

double VisibilityQuery::variance() const {
    const double n = taken;
    const double clear_share = (n * visibility() + 1.0) / (n + 2.0);
    const double effective = std::min(n, static_cast<double>(weight) * static_cast<double>(weight) /
                                             std::max(1e-30, static_cast<double>(weight_squared)));
    return clear_share * (1.0 - clear_share) / (effective + 1.0);
}

PairVisibility::PairVisibility(const HemisphereRays& samplers, const RayScene& ray_scene,
                               int points, std::uint64_t seed)
    : samplers_(samplers),
      ray_scene_(ray_scene),
      points_(static_cast<std::size_t>(points)),
      seed_(seed) {}

void PairVisibility::trace(Packet& packet, std::vector<VisibilityQuery>& queries) const {
    const std::uint32_t blocked = ray_scene_.blocked(packet.segments, packet.size);
    for (int k = 0; k < packet.size; ++k) {
        const float weight = packet.weight[k];
        if (!(weight > 0.0f)) continue;
        VisibilityQuery& query = queries[packet.query[k / four]];
        query.weight += weight;
        query.weight_squared += weight * weight;
        ++query.taken;
        if ((blocked >> k) & 1u) continue;
        query.clear_weight += weight;
        ++query.clear;
    }
    packet.size = 0;
}

std::array<std::uint32_t, 4> PairVisibility::scrambles(PatchIndex i, int turn) const {
    const std::uint64_t a = mix(seed_, (std::uint64_t{i} << 32) | static_cast<std::uint32_t>(turn)),
                        b = mix(a, 1);
    return {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(a >> 32),
            static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(b >> 32)};
}

void PairVisibility::measure(std::vector<VisibilityQuery>& queries,
                             const std::function<void()>& look_at_clock) const {
    Packet packet;
    const int wrap = static_cast<int>(points_.size());
    for (std::uint32_t q = 0; q < queries.size(); ++q) {
        if (look_at_clock && q % queries_between_looks == 0) look_at_clock();
        const VisibilityQuery& query = queries[q];
        const PatchSampler &from = samplers_.sampler(query.i), &to = samplers_.sampler(query.j);
        PairEnds ends{from,
                      to,
                      samplers_.lift(query.i) * from.normal,
                      samplers_.lift(query.j) * to.normal,
                      ray_scene_.shift(to.frame, from.frame).cast<float>(),
                      {}};
        int turn = -1;
        for (int n = query.first; n < query.first + query.count; n += four) {
            if (n / wrap != turn) {
                turn = n / wrap;
                ends.seeds = scrambles(query.i, turn);
            }
            make_four_samples(ends, points_, n % wrap, packet.size, packet.segments, packet.weight);
            packet.query[packet.size / four] = q;
            packet.size += four;
            if (packet.size == ray_batch) trace(packet, queries);
        }
    }
    if (packet.size > 0) trace(packet, queries);
}

}  // namespace patchlight
