#include "solver/findings/misplaced.h"

#include "solver/findings/surface_tree.h"
#include "solver/findings/walkers.h"
#include "solver/rays/low_discrepancy.h"
#include "solver/scene/finding_words.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>

namespace patchlight {

namespace {

constexpr int first_looks = ray_batch;  // of which mostly one meets a front
constexpr int all_looks = 16 * ray_batch;
constexpr float above_contact = 1.2f;  // of the contact distance: above what touches the sensor
constexpr std::size_t names_at_most = 10;

/// What is seen from a point, in directions that are uniform over a half space or all of space.
struct View {
    int fronts = 0;
    int backs = 0;
    int both = 0;  // fronts that a back coincides with: the floor under a cupboard, from within
    std::map<SurfaceIndex, int> backs_of{};
};

enum class Part : std::uint8_t { before, behind, around };

RayPoint direction(const RayPoint& normal, Part part, std::uint64_t seed) {
    const auto z = static_cast<float>(2.0 * uniform_of(mix(seed, 1)) - 1.0);
    const auto angle = static_cast<float>(2.0 * std::numbers::pi * uniform_of(mix(seed, 2)));
    const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
    const RayPoint way(r * std::cos(angle), r * std::sin(angle), z);
    if (part == Part::around) return way;
    const bool is_before = way.dot(normal) >= 0.0f;
    return is_before == (part == Part::before) ? way : RayPoint(-way);
}

/// Whether a surface that faces the other way lies at a point of surface s.
bool has_back_behind(const FlawSearch& search, SurfaceIndex s, const Vec3& p) {
    constexpr double reach = 1e-4;  // of the surface's size: where a ray lands is rounded [1]
    const std::vector<Surface>& surfaces = search.scene.surfaces;
    return std::any_of(search.overlaps.partners[s].begin(), search.overlaps.partners[s].end(),
                       [&](SurfaceIndex other) {
                           return surfaces[other].normal.dot(surfaces[s].normal) < 0.0 &&
                                  (nearest_point(surfaces[other], p) - p).norm() <=
                                      reach * std::sqrt(surfaces[s].area);
                       });
}

/// Ends as soon as a front is seen.
View look(const FlawSearch& search, const Vec3& point, const RayPoint& normal, Part part,
          std::uint64_t seed) {
    const FrameIndex frame = search.rays.frame_at(point);
    const RayPoint origin = search.rays.to_ray_space(point, frame) +
                            above_contact * search.rays.contact(frame) * normal;
    View view;
    for (int first = 0; first < all_looks && view.fronts == 0; first += ray_batch) {
        if (first >= first_looks && view.backs + view.both == 0 && part == Part::before) break;
        RayBatch batch{};
        for (int k = 0; k < ray_batch; ++k) {
            const RayPoint way =
                direction(normal, part, mix(seed, static_cast<std::uint64_t>(first + k)));
            batch.ox[k] = origin.x(), batch.oy[k] = origin.y(), batch.oz[k] = origin.z();
            batch.dx[k] = way.x(), batch.dy[k] = way.y(), batch.dz[k] = way.z();
            batch.frame[k] = frame;
        }
        LandingBatch landings{};
        search.rays.land(batch, ray_batch, landings);
        for (int k = 0; k < ray_batch; ++k) {
            if (landings.landing[k] == Landing::escaped) continue;
            const SurfaceIndex s = landings.surface[k];
            if (landings.landing[k] == Landing::back) {
                ++view.backs;
                ++view.backs_of[s];
                continue;
            }
            const Vec3 at = search.rays.from_ray_space(
                RayPoint(landings.x[k], landings.y[k], landings.z[k]).cast<double>(),
                search.rays.frame(s));
            ++(has_back_behind(search, s, at) ? view.both : view.fronts);
        }
    }
    return view;
}

View look_around(const FlawSearch& search, const Viewpoint& viewpoint, std::uint64_t seed) {
    return look(search, viewpoint.position, RayPoint::Zero(), Part::around, seed);
}

/// What lies before a sensor decides; where that is open space, what lies behind it.
bool is_misplaced(const FlawSearch& search, const Sensor& sensor, std::uint64_t seed) {
    const RayPoint normal = sensor.normal.cast<float>();
    for (const Part part : {Part::before, Part::behind}) {
        const View view = look(search, sensor.position, normal, part, seed);
        if (view.fronts > 0) return false;
        if (view.backs + view.both > 0) return view.backs > view.both;
    }
    return false;
}

std::string most_met(const FlawSearch& search, const View& view) {
    std::map<std::string, int> met;
    for (const auto& [surface, count] : view.backs_of) met[search.object_of(surface)] += count;
    const auto more = [](const auto& a, const auto& b) { return a.second < b.second; };
    return std::max_element(met.begin(), met.end(), more)->first;
}

constexpr const char* where = "in a solid, under the floor or outside the room";

/// "'plane' (12 of 100 points), 'desk' and 3 more".
std::string listed(const Scene& scene, const std::vector<bool>& misplaced) {
    std::vector<std::string> names;
    std::vector<bool> in_grid(scene.sensors.size(), false);
    for (const SensorGrid& grid : scene.grids) {
        const auto count =
            static_cast<std::size_t>(grid.count_u) * static_cast<std::size_t>(grid.count_v);
        const auto first = misplaced.begin() + static_cast<std::ptrdiff_t>(grid.first);
        const auto out = std::count(first, first + static_cast<std::ptrdiff_t>(count), true);
        for (std::size_t k = 0; k < count; ++k) in_grid[grid.first + k] = true;
        if (out > 0)
            names.push_back(quoted(grid.name) + " (" + std::to_string(out) + " of " +
                            std::to_string(count) + " points)");
    }
    for (std::size_t k = 0; k < scene.sensors.size(); ++k)
        if (misplaced[k] && !in_grid[k]) names.push_back(quoted(scene.sensors[k].name));
    std::string text;
    for (std::size_t k = 0; k < std::min(names.size(), names_at_most); ++k)
        text += (k > 0 ? ", " : "") + names[k];
    if (names.size() > names_at_most)
        text += " and " + std::to_string(names.size() - names_at_most) + " more";
    return text;
}

}  // namespace

namespace {

std::vector<bool> find_misplaced_sensors(const FlawSearch& search) {
    const std::vector<Sensor>& sensors = search.scene.sensors;
    std::vector<std::uint8_t> found(sensors.size(), 0);  // bits cannot be written in parallel
    tbb::parallel_for(std::size_t{0}, sensors.size(), [&](std::size_t k) {
        found[k] = is_misplaced(search, sensors[k], mix(mix(search.seed, 0x706c616365), k));
    });
    return {found.begin(), found.end()};
}

std::vector<Finding> misplaced_findings(const FlawSearch& search,
                                        const std::vector<bool>& misplaced,
                                        std::span<const Viewpoint> viewpoints) {
    std::vector<Finding> findings;
    const auto out = static_cast<std::size_t>(std::count(misplaced.begin(), misplaced.end(), true));
    if (out > 0)
        findings.push_back({"sensor-misplaced",
                            {},
                            std::string("sensors that see backs of surfaces alone lie ") + where +
                                ": " + listed(search.scene, misplaced) +
                                "; points of grids are left out of mean and uniformity",
                            "move them to where light is, or turn round the surfaces that they see "
                            "from behind",
                            out});
    for (std::size_t k = 0; k < viewpoints.size(); ++k) {
        const View view = look_around(search, viewpoints[k], mix(mix(search.seed, 0x76696577), k));
        if (view.fronts > 0 || view.backs <= view.both) continue;
        findings.push_back({"camera-misplaced",
                            {most_met(search, view)},
                            "the camera " + quoted(viewpoints[k].name) +
                                " sees backs of surfaces alone, most of " +
                                quoted(most_met(search, view)) + ": it lies " + where +
                                "; pictures do not draw backs, so it looks through them",
                            "move its `eye`, unless it is meant to look in from there"});
    }
    return findings;
}

}  // namespace

Misplaced find_misplaced(const FlawSearch& search, std::span<const Viewpoint> viewpoints) {
    Misplaced found;
    found.sensors = find_misplaced_sensors(search);
    found.findings = misplaced_findings(search, found.sensors, viewpoints);
    return found;
}

}  // namespace patchlight
