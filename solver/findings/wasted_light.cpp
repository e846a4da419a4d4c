#include "solver/findings/wasted_light.h"

#include "solver/findings/light_test.h"
#include "solver/findings/walkers.h"
#include "solver/rays/low_discrepancy.h"
#include "solver/scene/finding_words.h"
#include "solver/scene/polygon.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>

namespace patchlight {

namespace {

constexpr std::size_t most_wasteful = 1000;  // objects that are looked at
constexpr std::size_t first_rays = 64;       // of which mostly one meets a front
constexpr std::size_t all_rays = 4096;
constexpr std::size_t most_targets = 2000;  // surfaces that a lamp may reach past all rays
constexpr std::size_t tries = 8;            // of ways from a lamp to each of them

struct Fate {
    std::size_t fronts = 0;
    std::size_t backs = 0;
    std::size_t all = 0;
};

class WastedLight {
  public:
    explicit WastedLight(const FlawSearch& search) : search_(search), light_(search) {}

    std::vector<Finding> find(bool backs_are_told) const {
        std::map<ObjectIndex, std::vector<SurfaceIndex>> lamps;
        for (SurfaceIndex s = 0; s < search_.scene.surfaces.size(); ++s)
            if (light_.gives_light(s)) lamps[search_.scene.surfaces[s].object].push_back(s);
        std::vector<Finding> findings;
        std::size_t looked_at = 0;
        for (const auto& [object, surfaces] : lamps) {
            if (++looked_at > most_wasteful) break;
            const Fate fate = fate_of(surfaces);
            if (fate.fronts > 0 || (fate.backs > 0 && backs_are_told)) continue;
            if (lights_a_sensor(surfaces) || reaches_a_front(surfaces) || passes_an_edge(surfaces))
                continue;
            findings.push_back(finding_of(object, fate));
        }
        return findings;
    }

  private:
    /// Ends as soon as a front is met.
    Fate fate_of(const std::vector<SurfaceIndex>& surfaces) const {
        std::vector<double> power;
        for (const SurfaceIndex s : surfaces) power.push_back(light_.power()[s]);
        Fate fate;
        for (std::size_t rays = first_rays; fate.fronts == 0; rays = all_rays) {
            fate = {};
            const std::vector<SurfaceIndex> drawn =
                draw(power, rays, mix(search_.seed, surfaces.front()));
            std::vector<Walker> walkers;
            for (std::size_t k = 0; k < drawn.size(); ++k) {
                const SurfaceIndex s = surfaces[drawn[k]];
                const std::uint64_t seed = mix(mix(search_.seed, 0x7761737465 + s), k);
                walkers.push_back(leave(search_, s,
                                        SurfacePoints(search_.scene.surfaces[s]).at(seed),
                                        Side::front, seed));
            }
            fly(search_.rays, walkers);
            for (const Walker& walker : walkers) {
                fate.fronts += walker.landing == Landing::front;
                fate.backs += walker.landing == Landing::back;
                ++fate.all;
            }
            if (rays == all_rays) break;
        }
        return fate;
    }

    bool lights_a_sensor(const std::vector<SurfaceIndex>& surfaces) const {
        constexpr std::size_t most_sensors = 10'000;
        const std::vector<Sensor>& sensors = search_.scene.sensors;
        for (std::size_t k = 0; k < std::min(sensors.size(), most_sensors); ++k)
            for (const SurfaceIndex s : surfaces) {
                const Surface& lamp = search_.scene.surfaces[s];
                const Vec3 way = sensors[k].position - centroid(lamp.corners, lamp.normal);
                if (way.dot(lamp.normal) > 0.0 && way.dot(sensors[k].normal) < 0.0) return true;
            }
        return false;
    }

    /// Surfaces that are too small, or too far, for rays to meet them by chance.
    bool reaches_a_front(const std::vector<SurfaceIndex>& surfaces) const {
        const Scene& scene = search_.scene;
        const std::size_t lamp_step = 1 + surfaces.size() / 16;
        const std::size_t step = 1 + scene.surfaces.size() / most_targets;
        for (std::size_t l = 0; l < surfaces.size(); l += lamp_step)
            for (std::size_t t = 0; t < scene.surfaces.size(); t += step)
                if (sees(surfaces[l], static_cast<SurfaceIndex>(t))) return true;
        return false;
    }

    bool sees(SurfaceIndex lamp, SurfaceIndex target) const {
        const Surface &from = search_.scene.surfaces[lamp], &to = search_.scene.surfaces[target];
        if (lamp == target) return false;
        const auto is_before = [](const Surface& one, const Surface& other) {
            return std::any_of(other.corners.begin(), other.corners.end(), [&](const Vec3& p) {
                return (p - one.corners[0]).dot(one.normal) > 0.0;
            });
        };
        if (!is_before(from, to) || !is_before(to, from)) return false;
        const SurfacePoints starts(from), ends(to);
        for (std::size_t k = 0; k < tries; ++k) {
            const std::uint64_t seed = mix(mix(mix(search_.seed, lamp), target), k);
            Walker walker = leave(search_, lamp, starts.at(seed), Side::front, seed);
            const Vec3 way = ends.at(mix(seed, 9)) - starts.at(seed);
            if (!(way.dot(from.normal) > 0.0) || !(way.dot(to.normal) < 0.0)) continue;
            walker.direction = way.normalized().cast<float>();
            fly(search_.rays, std::span(&walker, 1));
            if (walker.landing == Landing::front) return true;
        }
        return false;
    }

    /// By ways close by edges of polygons, at any distance alike on a scale of powers, that end at
    /// a front: a sun may shine through a hole that neither rays nor surfaces tell of.
    bool passes_an_edge(const std::vector<SurfaceIndex>& surfaces) const {
        constexpr std::size_t at_a_time = 4096, rounds = 16;
        constexpr double closest = 1e-4;  // of an edge's length
        const Scene& scene = search_.scene;
        std::vector<SurfacePoints> points;
        for (const SurfaceIndex s : surfaces) points.emplace_back(scene.surfaces[s]);
        for (std::size_t round = 0; round < rounds; ++round) {
            std::vector<Walker> walkers;
            for (std::size_t k = 0; k < at_a_time; ++k) {
                const std::uint64_t seed =
                    mix(mix(search_.seed, 0x65646765), round * at_a_time + k);
                const std::size_t l = mix(seed, 0) % surfaces.size();
                const SurfaceIndex lamp = surfaces[l];
                const Surface& beside = scene.surfaces[mix(seed, 1) % scene.surfaces.size()];
                const std::size_t n = beside.corners.size(), c = mix(seed, 2) % n;
                const Vec3 along = beside.corners[(c + 1) % n] - beside.corners[c];
                const Vec3 from = points[l].at(seed),
                           at = beside.corners[c] + uniform_of(mix(seed, 3)) * along +
                                std::pow(closest, uniform_of(mix(seed, 4))) *
                                    along.cross(beside.normal);
                const Vec3 way = at - from;
                if (!(way.dot(scene.surfaces[lamp].normal) > 0.0)) continue;
                walkers.push_back(leave(search_, lamp, from, Side::front, seed));
                walkers.back().direction = way.normalized().cast<float>();
            }
            fly(search_.rays, walkers);
            if (std::any_of(walkers.begin(), walkers.end(),
                            [](const Walker& walker) { return walker.landing == Landing::front; }))
                return true;
        }
        return false;
    }

    Finding finding_of(ObjectIndex object, const Fate& fate) const {
        const std::string& name = search_.scene.objects[object].name;
        const double share = static_cast<double>(fate.backs) / static_cast<double>(fate.all);
        const std::string what = share > 0.995 ? "ends at backs of surfaces, which absorb it"
                                 : share < 0.005
                                     ? "leaves the scene"
                                     : "leaves the scene, but for " + share_text(share) +
                                           " that ends at backs of surfaces";
        return {
            "wasted-light",
            {name},
            "the light of " + quoted(name) + " meets no front of any surface: all of it " + what,
            "turn the lamp round (corners run counter-clockwise as seen from where it shines), "
            "or the surfaces that it should light",
            1};
    }

    const FlawSearch& search_;
    LightTest light_;
};

}  // namespace

std::vector<Finding> find_wasted_light(const FlawSearch& search, bool backs_are_told) {
    return WastedLight(search).find(backs_are_told);
}

}  // namespace patchlight
