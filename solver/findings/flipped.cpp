#include "solver/findings/flipped.h"

#include "solver/findings/light_test.h"
#include "solver/findings/surface_tree.h"
#include "solver/rays/low_discrepancy.h"
#include "solver/scene/finding_words.h"
#include "solver/scene/polygon.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace patchlight {

namespace {

constexpr std::size_t most_surfaces = 80'000;  // that are looked at: the largest
constexpr std::size_t all_rays = 1u << 19, fewest_rays = 8, most_rays = 64;
constexpr std::size_t confirming_rays = 256;  // that confirm what fewer found
constexpr double sees_nothing = 0.02;         // of a front's view that is fronts, at most [1]
constexpr double gets_light = 0.25;           // of a back's view that sends light, at least [1]
constexpr int lamp_flights = 8;               // after which light has found its way round a room
constexpr std::size_t most_partners = 256;
constexpr double off_contact = 1.5;      // of the local tolerance: in one plane [1]
constexpr std::size_t lamp_walks = 32;   // that look for a lamp, from each side of a surface
constexpr std::size_t most_judged = 64;  // surfaces of an object whose two sides both see fronts
constexpr double darker = 0.1;           // of the walks from the back: reach a lamp from the front

struct Views {
    double front = 0.0;        // of the front's view: what is fronts [1]
    double back = 0.0;         // of the back's view: fronts that are not in a hollow of backs [1]
    double back_fronts = 0.0;  // of the back's view: fronts [1]
};

/// Whether another polygon lies at p, in the plane of s. Surfaces that share their plane with too
/// many are left alone.
bool is_hidden(const FlawSearch& search, SurfaceIndex s, const Vec3& p) {
    const std::vector<SurfaceIndex>& partners = search.overlaps.partners[s];
    return partners.size() > most_partners ||
           std::any_of(partners.begin(), partners.end(), [&](SurfaceIndex other) {
               return (nearest_point(search.scene.surfaces[other], p) - p).norm() <=
                      off_contact * search.tolerance.between(s, other);
           });
}

class FlippedSearch {
  public:
    explicit FlippedSearch(const FlawSearch& search) : search_(search), light_(search) {}

    std::vector<Finding> find();

  private:
    std::vector<SurfaceIndex> candidates() const;
    std::vector<Walker> start(SurfaceIndex s, Side side, std::size_t count) const;
    std::vector<Views> look(std::span<const SurfaceIndex> surfaces, std::size_t rays) const;
    double lit_share(SurfaceIndex s, Side side, int last_flight) const;
    bool is_flipped(SurfaceIndex s, const Views& views) const;
    void judge_hollows(std::vector<SurfaceIndex>& both_see,
                       std::vector<SurfaceIndex>& flipped) const;
    Finding finding_of(std::span<const SurfaceIndex> flipped) const;

    const FlawSearch& search_;

    LightTest light_;
};

std::vector<SurfaceIndex> FlippedSearch::candidates() const {
    const Scene& scene = search_.scene;
    std::vector<SurfaceIndex> chosen;
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s)
        if (!scene.materials[scene.surfaces[s].material].two_sided) chosen.push_back(s);
    std::stable_sort(chosen.begin(), chosen.end(), [&](SurfaceIndex a, SurfaceIndex b) {
        return scene.surfaces[a].area > scene.surfaces[b].area;
    });
    if (chosen.size() > most_surfaces) chosen.resize(most_surfaces);
    std::sort(chosen.begin(), chosen.end());
    return chosen;
}

/// Those that would start on what hides them are not flying.
std::vector<Walker> FlippedSearch::start(SurfaceIndex s, Side side, std::size_t count) const {
    const SurfacePoints points(search_.scene.surfaces[s]);
    std::vector<Walker> walkers;
    walkers.reserve(count);
    for (std::size_t k = 0; k < count; ++k) {
        const std::uint64_t seed =
            mix(mix(search_.seed, s), 2 * k + (side == Side::back ? 1u : 0u));
        const Vec3 p = points.at(seed);
        walkers.push_back(leave(search_, s, p, side, seed));
        walkers.back().flying = !is_hidden(search_, s, p);
    }
    return walkers;
}

std::vector<Views> FlippedSearch::look(std::span<const SurfaceIndex> surfaces,
                                       std::size_t rays) const {
    std::array<std::vector<Walker>, 2> sides;
    for (auto& side : sides) side.resize(surfaces.size() * rays);
    tbb::parallel_for(std::size_t{0}, surfaces.size(), [&](std::size_t k) {
        for (const Side side : {Side::front, Side::back}) {
            const std::vector<Walker> walkers = start(surfaces[k], side, rays);
            std::copy(walkers.begin(), walkers.end(),
                      sides[side == Side::back].begin() + static_cast<std::ptrdiff_t>(k * rays));
        }
    });
    std::vector<Views> views(surfaces.size());
    const double share = 1.0 / static_cast<double>(rays);
    fly(search_.rays, sides[0]);
    fly(search_.rays, sides[1]);
    for (std::size_t k = 0; k < sides[0].size(); ++k) {
        const auto meets_front = [&](const Walker& w) {
            return w.flying && w.landing == Landing::front;
        };
        Views& view = views[k / rays];
        if (!sides[0][k].flying || meets_front(sides[0][k])) view.front += share;
        if (meets_front(sides[1][k])) view.back_fronts += share;
    }
    turn(search_, sides[1]);
    fly(search_.rays, sides[1]);
    for (std::size_t k = 0; k < sides[1].size(); ++k)
        if (sides[1][k].flying && sides[1][k].landing != Landing::back)
            views[k / rays].back += share;
    return views;
}

/// Of walks that leave one side: those that come to see a lamp, before any flight or after some.
double FlippedSearch::lit_share(SurfaceIndex s, Side side, int last_flight) const {
    std::vector<Walker> walkers = start(s, side, lamp_walks);
    const float sign = side == Side::front ? 1.0f : -1.0f;
    std::vector<RayPoint> normals(lamp_walks,
                                  sign * search_.scene.surfaces[s].normal.cast<float>());
    std::vector<bool> lit(lamp_walks, false);
    for (int flight = 0; flight <= last_flight; ++flight) {
        for (std::size_t k = 0; k < lamp_walks; ++k) {
            const Walker& walker = walkers[k];
            if (!walker.flying || lit[k]) continue;
            if (flight > 0)
                normals[k] = search_.scene.surfaces[walker.surface].normal.cast<float>();
            lit[k] = (flight > 0 && light_.gives_light(walker.surface)) ||
                     light_.sees_lamp(walker.origin, walker.frame, normals[k], walker.seed);
        }
        fly(search_.rays, walkers);
        turn(search_, walkers);
    }
    return static_cast<double>(std::count(lit.begin(), lit.end(), true)) / lamp_walks;
}

bool FlippedSearch::is_flipped(SurfaceIndex s, const Views& views) const {
    if (views.front > sees_nothing) return false;
    if (views.back >= gets_light) return true;
    return light_.any() && lit_share(s, Side::back, 0) >= gets_light &&
           lit_share(s, Side::front, 0) == 0.0;
}

/// Surfaces of one object of which both sides see fronts: flipped if most of them have a lamp
/// behind them, and none before them however light goes.
void FlippedSearch::judge_hollows(std::vector<SurfaceIndex>& both_see,
                                  std::vector<SurfaceIndex>& flipped) const {
    if (both_see.empty() || !light_.any()) return;
    const std::size_t step = (both_see.size() + most_judged - 1) / most_judged;
    std::size_t judged = 0, hollow = 0;
    for (std::size_t k = 0; k < both_see.size(); k += step, ++judged) {
        const double back = lit_share(both_see[k], Side::back, lamp_flights);
        hollow += back >= gets_light &&
                  lit_share(both_see[k], Side::front, lamp_flights) <= darker * back;
    }
    if (2 * hollow > judged) flipped.insert(flipped.end(), both_see.begin(), both_see.end());
}

Finding FlippedSearch::finding_of(std::span<const SurfaceIndex> flipped) const {
    const Scene& scene = search_.scene;
    const SurfaceIndex largest =
        *std::max_element(flipped.begin(), flipped.end(), [&](SurfaceIndex a, SurfaceIndex b) {
            return scene.surfaces[a].area < scene.surfaces[b].area;
        });
    const Surface& surface = scene.surfaces[largest];
    const std::string& name = search_.object_of(largest);
    return {
        "flipped-normals",
        {name},
        "light comes to the back of " + quoted(name) +
            ", which absorbs it, and its front sees none: near " +
            place_text(centroid(surface.corners, surface.normal), search_.size(largest)),
        "turn the polygon round (corners run counter-clockwise as seen from the front), or make "
        "its material `two_sided`",
        flipped.size()};
}

std::vector<Finding> FlippedSearch::find() {
    constexpr std::size_t at_a_time = 4096;
    const std::vector<SurfaceIndex> surfaces = candidates();
    if (surfaces.empty()) return {};
    const std::size_t rays = std::clamp(all_rays / surfaces.size(), fewest_rays, most_rays);
    std::map<ObjectIndex, std::vector<SurfaceIndex>> flipped, both_see;
    for (std::size_t first = 0; first < surfaces.size(); first += at_a_time) {
        if (search_.stopped()) break;
        const auto part =
            std::span(surfaces).subspan(first, std::min(at_a_time, surfaces.size() - first));
        const std::vector<Views> views = look(part, rays);
        for (std::size_t k = 0; k < part.size(); ++k) {
            const ObjectIndex object = search_.scene.surfaces[part[k]].object;
            if (views[k].front > sees_nothing && views[k].back >= gets_light)
                both_see[object].push_back(part[k]);
            else if (is_flipped(part[k], views[k]) &&
                     is_flipped(part[k], look(part.subspan(k, 1), confirming_rays)[0]))
                flipped[object].push_back(part[k]);
        }
    }
    for (auto& [object, list] : both_see) judge_hollows(list, flipped[object]);
    std::vector<Finding> findings;
    for (const auto& [object, list] : flipped)
        if (!list.empty()) findings.push_back(finding_of(list));
    return findings;
}

}  // namespace

std::vector<Finding> find_flipped(const FlawSearch& search) { return FlippedSearch(search).find(); }

}  // namespace patchlight
