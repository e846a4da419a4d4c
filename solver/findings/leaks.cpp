#include "solver/findings/leaks.h"

#include "solver/findings/walkers.h"
#include "solver/rays/low_discrepancy.h"
#include "solver/scene/finding_words.h"
#include "solver/scene/touching_pairs.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

namespace patchlight {

namespace {

constexpr std::size_t most_gaps = 2000;                 // that are looked into: the widest
constexpr std::size_t first_rays = 24, sure_rays = 96;  // from a gap to either end, at each tilt
constexpr std::array<double, 3> tilts{0.0, 0.8, -0.8};  // to the way straight through [rad]
constexpr double fan = 1.0;           // angle of the rays to the straight way through [rad]
constexpr int leak_flights = 6;       // that light goes on for
constexpr double blind = 6.0;         // gap widths: shorter flights are those in a slot [1]
constexpr double mostly = 2.0 / 3.0;  // of the light that ends outside: an end out of the room,
constexpr double in_the_open = 0.5;   // if so much escapes; else it is a hollow of backs [1]
constexpr double hardly = 0.2;        // of it, at most: an end within a room
constexpr std::size_t enough_places = 48;  // on a side, to tell whether it is the same room
constexpr double same_room = 0.03;         // of pairs of points that see each other, at least

/// What light finds that leaves a gap at one end.
struct End {
    double escaped = 0.0;              // share of it that ended in the open [1]
    double outside = 0.0;              // or on backs [1]
    bool is_place = false;             // wide beside the gap, and no slot
    std::vector<Walker> last;          // at fronts
    std::optional<SurfaceIndex> seen;  // the front that most of the first flights met
};

std::vector<Walker> fan_out(const FlawSearch& search, const Gap& gap, double sign, double tilt,
                            std::size_t rays, std::uint64_t seed) {
    const Vec3 through = std::cos(tilt) * sign * gap.along.cross(gap.across).normalized() +
                         std::sin(tilt) * gap.across;
    std::vector<Walker> walkers(rays);
    for (std::size_t k = 0; k < rays; ++k) {
        const double u =
            (static_cast<double>(k) + uniform_of(mix(seed, k))) / static_cast<double>(rays);
        const double angle = fan * (2.0 * u - 1.0);
        walkers[k].frame = search.rays.frame(gap.owner);
        walkers[k].origin = search.rays.to_ray_space(gap.middle, walkers[k].frame);
        walkers[k].direction =
            (std::cos(angle) * through + std::sin(angle) * gap.along).cast<float>();
        walkers[k].seed = mix(mix(seed, k), sign > 0.0 ? 1 : 2);
    }
    return walkers;
}

/// The front that most of them landed on.
std::optional<SurfaceIndex> most_frequent(std::span<const Walker> walkers) {
    std::map<SurfaceIndex, int> counts;
    for (const Walker& walker : walkers)
        if (walker.landing == Landing::front) ++counts[walker.surface];
    const auto most =
        std::max_element(counts.begin(), counts.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == counts.end() ? std::nullopt : std::optional(most->first);
}

/// Ways that end right at the gap tell nothing of the place beyond, and are given up.
void give_up_short_ones(std::vector<Walker>& walkers, double shortest) {
    std::erase_if(walkers, [&](const Walker& walker) {
        return walker.landing != Landing::escaped && walker.length < shortest;
    });
}

End look_into(const FlawSearch& search, std::vector<Walker> walkers, double shortest) {
    const std::size_t sent = walkers.size();
    End end;
    std::vector<float> lengths;
    for (int flight = 0; flight < leak_flights; ++flight) {
        fly(search.rays, walkers);
        if (flight == 0) {
            give_up_short_ones(walkers, shortest);
            if (2 * walkers.size() < sent) return end;
            end.seen = most_frequent(walkers);
        }
        for (const Walker& walker : walkers)
            if (flight > 0 && walker.flying && walker.landing != Landing::escaped)
                lengths.push_back(walker.length);
        turn(search, walkers);
    }
    for (const Walker& walker : walkers)
        if (walker.flying)
            end.last.push_back(walker);
        else if (walker.landing == Landing::escaped)
            end.escaped += 1.0 / static_cast<double>(walkers.size());
    end.outside = 1.0 - static_cast<double>(end.last.size()) / static_cast<double>(walkers.size());
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    end.is_place = lengths.empty() || static_cast<double>(*middle) >= shortest;
    return end;
}

/// The share of pairs of places, one from each end, that see each other.
double seen_share(const FlawSearch& search, std::span<const Walker> one,
                  std::span<const Walker> other) {
    double seen = 0.0, pairs = 0.0;
    for (const Walker& a : one)
        for (const Walker& b : other) {
            const RayPoint shift = search.rays.shift(b.frame, a.frame).cast<float>();
            const RayPoint way = b.origin + shift - a.origin;
            pairs += 1.0;
            if (way.dot(search.scene.surfaces[a.surface].normal.cast<float>()) <= 0.0f ||
                way.dot(search.scene.surfaces[b.surface].normal.cast<float>()) >= 0.0f)
                continue;
            RayBatch segment{};
            RayScene::set_segment(segment, 0, a.origin, a.frame, way, b.origin, b.frame);
            seen += search.rays.blocked(segment, 1) == 0;
        }
    return pairs > 0.0 ? seen / pairs : 0.0;
}

bool is_within(const End& end) { return end.is_place && end.seen && end.outside <= hardly; }

bool leads_out(const End& end) {
    return end.is_place && end.outside >= mostly && end.escaped >= in_the_open;
}

/// What is seen through a gap on either side of it, at each tilt.
struct GapViews {
    std::array<std::array<End, tilts.size()>, 2> sides;

    /// Of light that went on within a room on one side.
    std::vector<Walker> last_within(std::size_t side) const {
        std::vector<Walker> all;
        for (const End& end : sides[side])
            if (is_within(end))
                for (const Walker& walker : end.last)
                    if (all.size() < enough_places) all.push_back(walker);
        return all;
    }
};

GapViews look_through(const FlawSearch& search, const Gap& gap, std::size_t rays,
                      std::uint64_t seed) {
    const double shortest = blind * gap.width * search.rays.scale();
    GapViews views;
    for (const std::size_t side : {0u, 1u})
        for (std::size_t k = 0; k < tilts.size(); ++k)
            views.sides[side][k] = look_into(search,
                                             fan_out(search, gap, side == 0 ? 1.0 : -1.0, tilts[k],
                                                     rays, mix(seed, 2 * k + side)),
                                             shortest);
    return views;
}

std::optional<Leak> leak_at(const FlawSearch& search, const Gap& gap, std::size_t rays,
                            std::uint64_t seed) {
    const GapViews views = look_through(search, gap, rays, seed);
    for (const std::size_t inner : {0u, 1u})
        for (const End& end : views.sides[inner])
            if (is_within(end) && std::any_of(views.sides[1 - inner].begin(),
                                              views.sides[1 - inner].end(), leads_out))
                return Leak{gap, true, *end.seen};
    const std::vector<Walker> one = views.last_within(0), other = views.last_within(1);
    if (one.empty() || other.empty() || seen_share(search, one, other) >= same_room)
        return std::nullopt;
    return Leak{gap, false, one.front().surface};
}

std::vector<std::string> names_of(const FlawSearch& search, const Gap& gap) {
    std::vector<std::string> names{search.object_of(gap.owner)};
    if (search.object_of(gap.other) != names[0]) names.push_back(search.object_of(gap.other));
    return names;
}

}  // namespace

std::vector<Leak> find_leaks(const FlawSearch& search, std::span<const Gap> gaps) {
    std::vector<Gap> widest(gaps.begin(), gaps.end());
    std::stable_sort(widest.begin(), widest.end(),
                     [](const Gap& a, const Gap& b) { return a.width > b.width; });
    if (widest.size() > most_gaps) widest.resize(most_gaps);
    std::vector<std::optional<Leak>> found(widest.size());
    for_each_in_parallel(widest.size(), search.go_on, [&](std::size_t k) {
        const std::uint64_t seed = mix(search.seed, widest[k].edge);
        if (leak_at(search, widest[k], first_rays, seed))
            found[k] = leak_at(search, widest[k], sure_rays, mix(seed, sure_rays));
    });
    std::vector<Leak> leaks;
    for (const auto& leak : found)
        if (leak) leaks.push_back(*leak);
    return leaks;
}

std::vector<Finding> leak_findings(const FlawSearch& search, std::span<const Leak> leaks) {
    std::map<std::vector<std::string>, std::size_t> number_of;
    std::vector<Finding> findings;
    for (const Leak& leak : leaks) {  // widest first
        const std::vector<std::string> names = names_of(search, leak.gap);
        std::vector<std::string> pair = names;
        std::sort(pair.begin(), pair.end());
        const auto [known, is_new] = number_of.emplace(pair, findings.size());
        if (!is_new) {
            ++findings[known->second].count;
            continue;
        }
        findings.push_back(
            {"light-leak", names,
             (names.size() == 1
                  ? "parts of " + quoted(names[0]) + " do not quite meet"
                  : quoted(names[0]) + " and " + quoted(names[1]) + " do not quite meet") +
                 ": light gets " + (leak.leads_out ? "out" : "into another room") +
                 " through a gap of " + length_text(leak.gap.width) + " near " +
                 place_text(leak.gap.middle, search.size(leak.gap.owner)),
             "let them touch: move the edge onto the surface, or past it", 1});
    }
    return findings;
}

}  // namespace patchlight
