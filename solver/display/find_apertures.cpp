#include "solver/display/find_apertures.h"

#include "solver/display/aperture_set.h"
#include "solver/display/gap_probe.h"
#include "solver/rays/low_discrepancy.h"

#include <oneapi/tbb/parallel_for.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

namespace patchlight {

namespace {

constexpr double widest = 0.01;   // of the root of the area: gaps that are looked for [1]
constexpr double nearest = 1e-4;  // of the widest gap: beside an edge [1]
constexpr std::size_t lines_of_edge = 16, fewest_first = 8192, most_first = 100'000;
constexpr std::size_t fewest_next = 32'768;
constexpr std::size_t most_lines = 1'000'000;
constexpr std::size_t most_apertures = 512;
/// Lines through gaps that are known since new ones were found, for each of those, that end the
/// search: after n of them about 1/n of the light may come through gaps that are not.
constexpr std::size_t known_per_new = 128;
constexpr std::size_t lines_at_a_time = 256, looks_at_a_time = 256;

float number(std::uint64_t bits) { return static_cast<float>(bits >> 40) * 0x1p-24f; }

/// An edge of a polygon, and where beside it a gap may begin [ray space].
struct Edge {
    RayPoint from, along;  // `along`: whole
    RayPoint outward;      // unit, in the polygon's plane
    RayPoint normal;       // unit
};

class ApertureSearch {
  public:
    ApertureSearch(const Scene& scene, const RayScene& rays,
                   const std::vector<LightSource>& sources, const LampReach& reach,
                   std::uint64_t seed)
        : scene_(scene), rays_(rays), sources_(sources), reach_(reach), seed_(seed) {
        widest_ = static_cast<float>(widest * std::sqrt(reach.area) * rays.scale());
        source_of_.assign(scene.surfaces.size(), nullptr);
        double power = 0.0;
        for (const LightSource& source : sources) {
            source_of_[source.surface] = &source;
            power += source.power;
            power_.push_back(power);
            widest_lamp_ = std::max(widest_lamp_,
                                    static_cast<float>(narrow_side(source.polygon) * rays.scale()));
        }
        for (const Surface& surface : scene.surfaces)
            if (surface.side == Side::front) add_edges(surface);
    }

    std::vector<Aperture> find(const std::function<bool()>& go_on) {
        bool stopped = false;
        const auto may_go_on = [&] { return !(stopped = stopped || (go_on && !go_on())); };
        if (edges_.empty() || sources_.empty()) return {};
        std::size_t known_since = 0, first = 0,
                    count = std::clamp(lines_of_edge * edges_.size(), fewest_first, most_first);
        while (first < most_lines && found_.size() < most_apertures && may_go_on()) {
            std::vector<Passage> now = passages(first, first + count);
            std::ranges::stable_partition(  // a gap is told best by light that goes straight
                now, [](const Passage& passage) { return !passage.grazes(); });
            std::size_t new_ones = 0, known_ones = 0;
            for (std::size_t k = 0; k < now.size() && may_go_on(); k += looks_at_a_time) {
                const auto some =
                    std::span(now).subspan(k, std::min(looks_at_a_time, now.size() - k));
                const std::vector<std::optional<Aperture>> gaps = probe(some);
                for (std::size_t n = 0; n < some.size(); ++n) {
                    if (is_known(some[n]))
                        ++known_ones;
                    else if (gaps[n] && add(*gaps[n], some[n]))
                        ++new_ones;
                }
            }
            first += count;
            known_since = new_ones > 0 ? known_ones : known_since + known_ones;
            if (found_.empty() || known_since >= known_per_new * std::max<std::size_t>(1, new_ones))
                break;
            count = std::min(std::max(count, fewest_next), most_lines - first);
        }
        return found_.all();
    }

  private:
    /// A line that goes from a source by an edge to a front.
    struct Passage {
        RayPoint point, direction;          // unit, away from the source
        float before = 0.0f, after = 0.0f;  // to the source, and to the front
        const Edge* edge = nullptr;
        const LightSource* source = nullptr;

        bool grazes() const { return std::abs(direction.dot(edge->normal)) < GapProbe::grazing; }
        RayPoint from() const { return point - before * direction; }
        RayPoint whole() const { return (before + after) * direction; }
    };

    void add_edges(const Surface& surface) {
        const std::size_t n = surface.corners.size();
        for (std::size_t k = 0; k < n; ++k) {
            const Vec3 along = surface.corners[(k + 1) % n] - surface.corners[k];
            if (!(along.norm() > 0.0)) continue;
            Edge edge;
            edge.from = rays_.to_ray_space(surface.corners[k]);
            edge.along = (along * rays_.scale()).cast<float>();
            edge.outward = along.cross(surface.normal).normalized().cast<float>();
            edge.normal = surface.normal.cast<float>();
            edges_.push_back(edge);
        }
    }

    struct Line {
        const Edge* edge = nullptr;
        RayPoint point, direction;  // towards where a source may be
    };
    /// Beside an edge, at any distance alike on a scale of powers; towards a source, or anywhere.
    Line line(std::size_t n) const {
        const std::uint64_t key = mix(seed_, n);
        const auto random = [&](std::uint64_t k) { return number(mix(key, k)); };
        Line line;
        line.edge = &edges_[mix(key, 0) % edges_.size()];
        const auto distance = static_cast<float>(static_cast<double>(widest_) *
                                                 std::pow(nearest, static_cast<double>(random(1))));
        line.point = line.edge->from + random(2) * line.edge->along + distance * line.edge->outward;
        if (n % 2 == 0) {
            const double at = static_cast<double>(random(3)) * power_.back();
            const auto k = std::min<std::size_t>(
                static_cast<std::size_t>(std::upper_bound(power_.begin(), power_.end(), at) -
                                         power_.begin()),
                power_.size() - 1);
            const std::size_t any = mix(key, 4) % sources_.size();
            const LightSource& source = sources_[n % 4 == 0 ? k : any];
            line.direction = (source.sampler.at(random(5), random(6)) - line.point).normalized();
        } else if (n % 4 == 1 && !known_.empty()) {
            line.direction = known_[mix(key, 7) % known_.size()];
        } else {
            const float z = 2.0f * random(5) - 1.0f,
                        turn = 2.0f * std::numbers::pi_v<float> * random(6),
                        r = std::sqrt(std::max(0.0f, 1.0f - z * z));
            line.direction = {r * std::cos(turn), r * std::sin(turn), z};
        }
        return line;
    }

    /// Of lines [first, end), in their order.
    std::vector<Passage> passages(std::size_t first, std::size_t end) const {
        const std::size_t chunks = (end - first + lines_at_a_time - 1) / lines_at_a_time;
        std::vector<std::vector<Passage>> of_chunk(chunks);
        tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
            const std::size_t from = first + chunk * lines_at_a_time;
            follow(from, std::min(from + lines_at_a_time, end), of_chunk[chunk]);
        });
        std::vector<Passage> all;
        for (const auto& part : of_chunk) all.insert(all.end(), part.begin(), part.end());
        return all;
    }

    void follow(std::size_t first, std::size_t end, std::vector<Passage>& found) const {
        RayBatch batch;
        LandingBatch ahead, behind;
        std::array<Line, ray_batch> lines;
        for (; first < end; first += ray_batch) {
            const auto count = static_cast<int>(std::min<std::size_t>(ray_batch, end - first));
            const auto fill = [&](float sign) {
                for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
                    const RayPoint &o = lines[k].point, d = sign * lines[k].direction;
                    batch.ox[k] = o.x(), batch.oy[k] = o.y(), batch.oz[k] = o.z();
                    batch.dx[k] = d.x(), batch.dy[k] = d.y(), batch.dz[k] = d.z();
                }
            };
            for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k)
                lines[k] = line(first + k);
            fill(1.0f);
            rays_.land(batch, count, ahead);
            fill(-1.0f);
            rays_.land(batch, count, behind);
            for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
                if (ahead.landing[k] != Landing::front || behind.landing[k] != Landing::front)
                    continue;
                const LightSource* source = source_of_[ahead.surface[k]];
                if (!source || !sends_back(behind.surface[k])) continue;
                const auto distance = [&](const LandingBatch& to) {
                    return (RayPoint(to.x[k], to.y[k], to.z[k]) - lines[k].point).norm();
                };
                found.push_back({lines[k].point, -lines[k].direction, distance(ahead),
                                 distance(behind), lines[k].edge, source});
            }
        }
    }

    bool sends_back(SurfaceIndex s) const {
        return (scene_.materials[scene_.surfaces[s].material].reflectance > 0.0).any();
    }

    bool is_known(const Passage& passage) const {
        return found_.count_crossed(passage.from(), passage.whole()) > 0;
    }

    /// The gaps there that are not known yet, if there are any, and worth it.
    std::vector<std::optional<Aperture>> probe(std::span<const Passage> passages) const {
        std::vector<std::optional<Aperture>> gaps(passages.size());
        tbb::parallel_for(std::size_t{0}, passages.size(), [&](std::size_t k) {
            if (!is_known(passages[k])) gaps[k] = gap_at(passages[k]);
        });
        return gaps;
    }

    std::optional<Aperture> gap_at(const Passage& passage) const {
        const GapProbe probe{rays_, passage.direction,
                             std::min({passage.before, passage.after, 10.0f * widest_}), widest_};
        auto gap = probe.find(passage.point, passage.edge->outward, passage.edge->along,
                              passage.edge->normal);
        if (!gap || !is_worth_it(*gap, passage)) return std::nullopt;
        gap->hides_lamps = seen_through(*gap, passage) < little * widest_lamp_ || is_sun(passage);
        return gap;
    }

    bool add(const Aperture& gap, const Passage& passage) {
        if (found_.size() >= most_apertures) return false;
        found_.add(gap);
        known_.push_back(-passage.direction);
        return true;
    }

    static constexpr float little = 0.25f;  // of a lamp

    /// How wide a part of a plane at the lamp is seen through it.
    static float seen_through(const Aperture& gap, const Passage& passage) {
        return std::min(gap.first_edge.norm(), gap.second_edge.norm()) *
               (passage.before + passage.after) / passage.after;
    }

    float width_of_lamp(const Passage& passage) const {
        return static_cast<float>(narrow_side(passage.source->polygon) * rays_.scale());
    }

    /// A small lamp, and one that lights hardly anything but through gaps.
    bool is_sun(const Passage& passage) const {
        constexpr float small = 0.03f;         // of its distance
        constexpr double lights_a_room = 0.1;  // of its rays: its spots are as bright as the rest
        const auto number = static_cast<std::size_t>(passage.source - sources_.data());
        return width_of_lamp(passage) < small * passage.before &&
               reach_.landed[number] < lights_a_room;
    }

    /// A lamp of which little is seen through the gap, or a spot that vertices may miss.
    bool is_worth_it(const Aperture& gap, const Passage& passage) const {
        constexpr float spot_of_widest = 0.75f;
        constexpr float of_a_sun = 4.0f;  // two to three vertices across: nothing else is as bright
        constexpr float far_from_both = 0.25f;  // else it is an edge that light grazes, or no gap
        const float width = std::min(gap.first_edge.norm(), gap.second_edge.norm()),
                    lamp = width_of_lamp(passage);
        if (width > far_from_both * std::min(passage.before, passage.after)) return false;
        const float seen = seen_through(gap, passage),
                    spot = width * (1.0f + passage.after / passage.before) +
                           lamp * passage.after / passage.before;
        const float narrow = is_sun(passage) ? of_a_sun : spot_of_widest;
        return seen < little * lamp || spot < narrow * widest_;
    }

    const Scene& scene_;
    const RayScene& rays_;
    const std::vector<LightSource>& sources_;
    const LampReach& reach_;
    std::uint64_t seed_;
    float widest_ = 0.0f, widest_lamp_ = 0.0f;   // gap, and lamp [ray space]
    std::vector<const LightSource*> source_of_;  // per surface
    std::vector<double> power_;                  // cumulated
    std::vector<Edge> edges_;
    ApertureSet found_;
    std::vector<RayPoint> known_;  // directions in which some were found, towards sources
};

}  // namespace

std::vector<Aperture> find_apertures(const Scene& scene, const RayScene& rays,
                                     const std::vector<LightSource>& sources,
                                     const LampReach& reach, std::uint64_t seed,
                                     const std::function<bool()>& go_on) {
    if (rays.frames() > 1) return {};  // they are known in one frame alone
    return ApertureSearch(scene, rays, sources, reach, seed).find(go_on);
}

}  // namespace patchlight
