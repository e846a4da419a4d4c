#include "solver/accuracy/light_particles.h"
#include "solver/rays/cosine_directions.h"
#include "solver/rays/low_discrepancy.h"
#include "solver/rays/patch_sampler.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patchlight {

namespace {

constexpr std::size_t particles_at_a_time = 1024;
constexpr float dim = 0.25f;  // of its first flux: from there on chance ends paths, so that what
                              // goes on carries about as much [1]
constexpr std::uint16_t most_bounces = 10'000;

float float_number(std::uint64_t bits) { return static_cast<float>(bits >> 40) * 0x1p-24f; }

float largest_of(const std::array<float, 3>& flux) { return std::max({flux[0], flux[1], flux[2]}); }

}  // namespace

struct LightParticles::Flight {
    RayPoint origin, direction;
    FrameIndex frame = 0;
    std::array<float, 3> flux{};
    float dim_at = 0.0f;  // flux from which on chance ends it
    std::uint32_t path = 0;
    std::uint16_t bounces = 0;
    float aperture_at = 0.0f;  // distance of the one it is aimed through; 0: of none
};

struct LightParticles::Tracer {
    const LightParticles& from;
    const SobolPoints& points;
    std::uint64_t seed;
    std::array<std::uint32_t, 4> seeds;
    float per_particle;  // one over their number
    std::vector<ParticleLanding> landings = {};
    std::vector<std::uint64_t> sent = {};  // per lamp
    std::vector<double> power = {};        // per lamp, towards what sends light back [W]
    std::uint64_t rays = 0;

    /// By chance: low bits of a number say where in the Sobol sequence its point lies.
    bool is_aimed(std::size_t n) const {
        return !from.apertures_.empty() && mix(mix(seed, n), 1) % 2 == 1;
    }

    /// From a point of an aperture back to what lights it: false if nothing does.
    bool look_back(std::size_t n, const Beam& beam, const Aperture& aperture,
                   const std::array<float, 2>& place, const std::array<float, 2>& way,
                   Flight& flight) {
        const std::size_t side =
            unit(mix(mix(seed, n), 2)) < static_cast<double>(beam.of_side[0]) ? 0 : 1;
        const RayPoint point = aperture.at(place[0], place[1]),
                       outward = side == 0 ? aperture.normal : RayPoint(-aperture.normal),
                       direction = cosine_direction(frame_about(outward), way[0], way[1]);
        RayBatch batch;
        LandingBatch landed;
        batch.ox[0] = point.x(), batch.oy[0] = point.y(), batch.oz[0] = point.z();
        batch.dx[0] = direction.x(), batch.dy[0] = direction.y(), batch.dz[0] = direction.z();
        batch.frame[0] = 0;
        from.rays_.land(batch, 1, landed);
        ++rays;
        if (landed.landing[0] != Landing::front) return false;
        const SurfaceIndex s = landed.surface[0];
        const RayPoint& normal = from.normals_[s];
        flight.origin =
            RayPoint(landed.x[0], landed.y[0], landed.z[0]) + from.rays_.lift(s) * normal;
        const RayPoint ray = point - flight.origin;
        flight.aperture_at = ray.norm();
        if (!(flight.aperture_at > 0.0f)) return false;
        flight.direction = ray / flight.aperture_at;
        flight.frame = 0;
        const auto scale = static_cast<float>(from.rays_.scale());
        const float weight = 2.0f * per_particle * aperture.area /
                             (scale * scale * beam.chance * beam.of_side[side]);
        for (std::size_t c = 0; c < 3; ++c) flight.flux[c] = from.exitance_[s][c] * weight;
        flight.dim_at = dim * largest_of(flight.flux);
        flight.path = static_cast<std::uint32_t>(n);
        flight.bounces = 0;
        return flight.dim_at > 0.0f;
    }

    /// False if nothing goes that way.
    bool start(std::size_t n, Flight& flight) {
        const double share = (static_cast<double>(n) + 0.5) / static_cast<double>(points.size());
        const auto found = std::lower_bound(
            from.emitters_.begin(), from.emitters_.end() - 1, share,
            [](const Emitter& emitter, double at) { return emitter.cumulative < at; });
        const auto coordinate = [&](std::size_t d) { return points.at(d, n, seeds[d]); };
        const SurfaceIndex s = from.mesh_.patches[found->patch].surface;
        const RayPoint& normal = from.normals_[s];
        const PatchSampler sampler =
            make_sampler(from.mesh_, found->patch, from.scene_.surfaces[s].normal, from.rays_);
        flight.origin = sampler.at(coordinate(0), coordinate(1)) + from.rays_.lift(s) * normal;
        flight.frame = sampler.frame;
        flight.aperture_at = 0.0f;
        float weight = per_particle;
        if (is_aimed(n)) {
            const auto& beams = from.beams_;
            const double at = unit(mix(mix(seed, n), 0)) * beams.back().cumulative;
            const std::size_t g = static_cast<std::size_t>(
                std::lower_bound(beams.begin(), beams.end() - 1, at,
                                 [](const Beam& beam, double to) { return beam.cumulative < to; }) -
                beams.begin());
            const Aperture& aperture = from.apertures_[g];
            if (beams[g].is_wide)
                return look_back(n, beams[g], aperture, {coordinate(0), coordinate(1)},
                                 {coordinate(2), coordinate(3)}, flight);
            const RayPoint ray = aperture.at(coordinate(2), coordinate(3)) - flight.origin;
            const float squared = std::max(1e-14f, ray.squaredNorm());
            flight.aperture_at = std::sqrt(squared);
            flight.direction = ray / flight.aperture_at;
            weight *= 2.0f * std::max(0.0f, flight.direction.dot(normal)) *
                      std::abs(flight.direction.dot(aperture.normal)) * aperture.area * 1.0f /
                      (beams[g].chance * squared * std::numbers::pi_v<float>);
        } else {
            if (!from.apertures_.empty()) weight *= 2.0f;
            const Cone cone = from.cone_from(flight.origin);
            if (cone.cosine > 0.0f) {
                const float z = 1.0f - coordinate(2) * (1.0f - cone.cosine),
                            turn = 2.0f * std::numbers::pi_v<float> * coordinate(3),
                            r = std::sqrt(std::max(0.0f, 1.0f - z * z));
                const RayFrame frame = frame_about(cone.axis);
                flight.direction = r * std::cos(turn) * frame.tangent +
                                   r * std::sin(turn) * frame.bitangent + z * frame.normal;
                weight *=
                    2.0f * (1.0f - cone.cosine) * std::max(0.0f, flight.direction.dot(normal));
            } else {
                flight.direction =
                    cosine_direction(frame_about(normal), coordinate(2), coordinate(3));
            }
            ++sent[found->lamp];
            double y = 0.0;
            constexpr std::array<double, 3> luminance_of{0.2126, 0.7152, 0.0722};
            for (std::size_t c = 0; c < 3; ++c)
                y += luminance_of[c] * static_cast<double>(found->flux[c]);
            power[found->lamp] += y * static_cast<double>(weight);
        }
        for (std::size_t c = 0; c < 3; ++c) flight.flux[c] = found->flux[c] * weight;
        flight.dim_at = dim * largest_of(flight.flux);
        flight.path = static_cast<std::uint32_t>(n);
        flight.bounces = 0;
        return weight > 0.0f;
    }

    /// Of light straight from a lamp, as often as it is counted here: what goes through apertures
    /// is counted by those alone.
    float share(const Flight& flight, const RayPoint& at) const {
        if (flight.bounces > 0 || from.apertures_.empty()) return 1.0f;
        constexpr float short_of = 0.9999f;
        const RayPoint whole = at - flight.origin;
        const int crossed = from.apertures_.count_crossed(flight.origin, whole);
        if (flight.aperture_at == 0.0f) return crossed == 0 ? 1.0f : 0.0f;
        if (whole.norm() < short_of * flight.aperture_at) return 0.0f;
        return 1.0f / static_cast<float>(std::max(1, crossed));
    }

    /// Where it landed on a front; false if it ends there.
    bool bounce(Flight& flight, SurfaceIndex s, const RayPoint& at) {
        const float counted = share(flight, at);
        if (!(counted > 0.0f)) return false;
        for (float& flux : flight.flux) flux *= counted;
        flight.dim_at *= counted;
        landings.push_back({at, s, flight.flux, flight.path, flight.bounces});
        const std::uint64_t stream = mix(mix(seed, flight.path), ++flight.bounces);
        for (std::size_t c = 0; c < 3; ++c) flight.flux[c] *= from.reflectance_[s][c];
        const float most = largest_of(flight.flux);
        if (!(most > 0.0f) || flight.bounces == most_bounces) return false;
        if (most < flight.dim_at) {
            if (float_number(mix(stream, 0)) * flight.dim_at >= most) return false;
            for (float& flux : flight.flux) flux *= flight.dim_at / most;
        }
        flight.frame = from.rays_.frame(s);
        flight.origin = at + from.rays_.lift(s) * from.normals_[s];
        flight.direction =
            cosine_direction(frame_about(from.normals_[s]), float_number(mix(stream, 1)),
                             float_number(mix(stream, 2)));
        return true;
    }

    void trace(std::size_t next, std::size_t end) {
        std::array<Flight, ray_batch> flights;
        std::size_t count = 0;
        RayBatch batch;
        LandingBatch landed;
        for (;;) {
            while (count < ray_batch && next < end)
                if (start(next++, flights[count])) ++count;
            if (count == 0) return;
            for (std::size_t k = 0; k < count; ++k) {
                const Flight& flight = flights[k];
                batch.ox[k] = flight.origin.x(), batch.dx[k] = flight.direction.x();
                batch.oy[k] = flight.origin.y(), batch.dy[k] = flight.direction.y();
                batch.oz[k] = flight.origin.z(), batch.dz[k] = flight.direction.z();
                batch.frame[k] = flight.frame;
            }
            from.rays_.land(batch, static_cast<int>(count), landed);
            rays += count;
            std::size_t left = 0;
            for (std::size_t k = 0; k < count; ++k)
                if (landed.landing[k] == Landing::front &&
                    bounce(flights[k], landed.surface[k],
                           RayPoint(landed.x[k], landed.y[k], landed.z[k])))
                    flights[left++] = flights[k];
            count = left;
        }
    }
};

ParticleFlux LightParticles::send(std::size_t count, std::uint64_t seed) const {
    ParticleFlux flux;
    flux.lamps.resize(lamp_power_.size());
    if (empty()) return flux;
    const std::size_t chunks = (count + particles_at_a_time - 1) / particles_at_a_time;
    const SobolPoints points(chunks * particles_at_a_time);
    std::array<std::uint32_t, 4> seeds{};
    for (std::uint64_t d = 0; d < seeds.size(); ++d)
        seeds[d] = static_cast<std::uint32_t>(mix(seed, d));
    std::vector<Tracer> tracers(
        chunks, Tracer{*this, points, seed, seeds, 1.0f / static_cast<float>(points.size())});
    tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
        tracers[chunk].sent.assign(lamp_power_.size(), 0);
        tracers[chunk].power.assign(lamp_power_.size(), 0.0);
        tracers[chunk].trace(chunk * particles_at_a_time, (chunk + 1) * particles_at_a_time);
    });
    flux.particles = points.size();
    for (Tracer& tracer : tracers) {
        flux.landings.insert(flux.landings.end(), tracer.landings.begin(), tracer.landings.end());
        flux.rays += tracer.rays;
        for (std::size_t lamp = 0; lamp < flux.lamps.size(); ++lamp) {
            flux.lamps[lamp].particles += tracer.sent[lamp];
            flux.lamps[lamp].power += tracer.power[lamp];
        }
        std::vector<ParticleLanding>().swap(tracer.landings);
    }
    return flux;
}

}  // namespace patchlight
