#include "solver/findings/leaks.h"

#include "solver/findings/walkers.h"
#include "solver/rays/low_discrepancy.h"
#include "solver/scene/finding_words.h"

#include <oneapi/tbb/parallel_for.h>
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

constexpr std::size_t most_gaps = 2000;  // that are looked into: the widest
constexpr std::size_t rays = 32;         // from a gap to either end
constexpr double fan = 1.0;              // angle of the rays to the straight way through [rad]
constexpr int flights = 6;               // that light goes on for
constexpr double blind = 6.0;            // gap widths: shorter flights are those in a slot [1]
constexpr double mostly = 2.0 / 3.0;     // of the light that ends outside: an end out of the room,
constexpr double in_the_open = 0.5;      // if so much escapes; else it is a hollow of backs [1]
constexpr double hardly = 1.0 / 3.0;     // of it, at most: an end within a room
constexpr double same_room = 0.03;       // of pairs of points that see each other, at least

/// What light finds that leaves a gap at one end.
struct End {
    double escaped = 0.0;              // share of it that ended in the open [1]
    double outside = 0.0;              // or on backs [1]
    double usual_flight = 0.0;         // median, after the first [ray space]
    std::vector<Walker> last;          // at fronts
    std::optional<SurfaceIndex> seen;  // the front that most of the first flights met
};

std::vector<Walker> fan_out(const FlawSearch& search, const Gap& gap, double sign,
                            std::uint64_t seed) {
    const Vec3 through = sign * gap.along.cross(gap.across).normalized();
    std::vector<Walker> walkers(rays);
    for (std::size_t k = 0; k < rays; ++k) {
        const double u = (static_cast<double>(k) + uniform_of(mix(seed, k))) / rays;
        const double angle = fan * (2.0 * u - 1.0);
        walkers[k].origin = search.rays.to_ray_space(gap.middle);
        walkers[k].direction =
            (std::cos(angle) * through + std::sin(angle) * gap.along).cast<float>();
        walkers[k].seed = mix(mix(seed, k), sign > 0.0 ? 1 : 2);
    }
    return walkers;
}

SurfaceIndex most_frequent(std::span<const Walker> walkers) {
    std::map<SurfaceIndex, int> counts;
    for (const Walker& walker : walkers)
        if (walker.landing == Landing::front) ++counts[walker.surface];
    return std::max_element(counts.begin(), counts.end(),
                            [](const auto& a, const auto& b) { return a.second < b.second; })
        ->first;
}

End look_into(const FlawSearch& search, const Gap& gap, double sign, std::uint64_t seed) {
    std::vector<Walker> walkers = fan_out(search, gap, sign, seed);
    End end;
    std::vector<float> lengths;
    for (int flight = 0; flight < flights; ++flight) {
        fly(search.rays, walkers);
        if (flight == 0 && std::any_of(walkers.begin(), walkers.end(),
                                       [](const Walker& w) { return w.landing == Landing::front; }))
            end.seen = most_frequent(walkers);
        for (const Walker& walker : walkers)
            if (flight > 0 && walker.flying && walker.landing != Landing::escaped)
                lengths.push_back(walker.length());
        turn(search, walkers);
    }
    for (const Walker& walker : walkers)
        if (walker.flying)
            end.last.push_back(walker);
        else if (walker.landing == Landing::escaped)
            end.escaped += 1.0 / rays;
    end.outside = 1.0 - static_cast<double>(end.last.size()) / rays;
    if (!lengths.empty()) {
        const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
        std::nth_element(lengths.begin(), middle, lengths.end());
        end.usual_flight = static_cast<double>(*middle);
    }
    return end;
}

/// The share of pairs of places, one from each end, that see each other.
double seen_share(const FlawSearch& search, const End& one, const End& other) {
    double seen = 0.0, pairs = 0.0;
    for (const Walker& a : one.last)
        for (const Walker& b : other.last) {
            const RayPoint way = b.origin - a.origin;
            pairs += 1.0;
            if (way.dot(search.scene.surfaces[a.surface].normal.cast<float>()) <= 0.0f ||
                way.dot(search.scene.surfaces[b.surface].normal.cast<float>()) >= 0.0f)
                continue;
            RayBatch segment{};
            segment.ox[0] = a.origin.x(), segment.oy[0] = a.origin.y();
            segment.oz[0] = a.origin.z();
            segment.dx[0] = way.x(), segment.dy[0] = way.y(), segment.dz[0] = way.z();
            seen += search.rays.blocked(segment, 1) == 0;
        }
    return pairs > 0.0 ? seen / pairs : 0.0;
}

std::optional<Leak> leak_at(const FlawSearch& search, const Gap& gap, std::uint64_t seed) {
    const std::array<End, 2> ends{look_into(search, gap, 1.0, seed),
                                  look_into(search, gap, -1.0, seed)};
    const double shortest = blind * gap.width * search.rays.scale();
    for (const End& end : ends)
        if (!end.last.empty() && end.usual_flight < shortest) return std::nullopt;
    const std::size_t inner = ends[0].outside <= ends[1].outside ? 0 : 1;
    const End &within = ends[inner], &beyond = ends[1 - inner];
    if (within.outside > hardly || !within.seen) return std::nullopt;
    if (beyond.outside >= mostly && beyond.escaped >= in_the_open)
        return Leak{gap, true, *within.seen};
    if (beyond.outside > hardly || seen_share(search, within, beyond) >= same_room)
        return std::nullopt;
    return Leak{gap, false, *within.seen};
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
    tbb::parallel_for(std::size_t{0}, widest.size(), [&](std::size_t k) {
        found[k] = leak_at(search, widest[k], mix(search.seed, widest[k].edge));
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
                 place_text(leak.gap.middle, search.size),
             "let them touch: move the edge onto the surface, or past it", 1});
    }
    return findings;
}

}  // namespace patchlight
