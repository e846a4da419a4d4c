#include "tests/bench/useful_light.h"

#include "tests/bench/bins.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace patchlight {

namespace {

constexpr std::size_t tasks = 16;
constexpr std::size_t searches_a_launch = 5;
constexpr int rounds = 12, search_rounds = 5;
constexpr double found_enough = 20'000.0;  // samples as good as of even weight: no more is searched
constexpr double most_kept = 60'000.0;     // samples from one round to the next
constexpr double a_lamp = 200.0;           // as many are enough of one lamp
constexpr double trifle = 3e-4;            // of all flux [1]
constexpr double plenty = 40'000.0;        // nothing more is learned either
constexpr double gain = 1.2;               // in those a launch: less, and nothing more is learned
constexpr double by_area = 0.7;            // share of searches; the others evenly over surfaces
constexpr double a_bin = 12.0;             // landings by which radiosity is told

struct Found {
    UsefulLight light;
    Landed landed;
    double yield = 0.0;     // reflected light per area of the lamp and of its disc [W]
    double sought = 0.0;    // density of searches of one round
    double expected = 0.0;  // density of all launches and searches so far
};

class Search {
  public:
    Search(const TracedScene& traced, const Emission& emission, std::size_t searches)
        : traced_(traced), emission_(emission), searches_(searches) {
        const Scene& scene = traced.scene();
        for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s) {
            if (!(reflectance(s) > 0.0).any()) continue;
            fronts_.push_back(s);
            area_ += scene.surfaces[s].area;
            cumulated_.push_back(area_);
        }
    }
    bool is_dark() const { return fronts_.empty(); }
    std::size_t launches() const { return searches_ / searches_a_launch; }

    std::vector<Found> round(const Emission& emission, bool search, std::uint64_t seed) const {
        std::vector<std::vector<Found>> found(tasks);
        tbb::parallel_for(std::size_t{0}, tasks, [&](std::size_t task) {
            Random random(seed, task);
            for (std::size_t k = 0; k < launches() / tasks; ++k)
                sent(emission, random, found[task]);
            for (std::size_t k = 0; search && k < searches_ / tasks; ++k)
                sought(random, found[task]);
        });
        std::vector<Found> all;
        for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
        return all;
    }

  private:
    Rgb reflectance(SurfaceIndex s) const {
        return traced_.scene().materials[traced_.scene().surfaces[s].material].reflectance;
    }
    double area(SurfaceIndex s) const { return traced_.scene().surfaces[s].area; }
    const Vec3& normal(SurfaceIndex s) const { return traced_.scene().surfaces[s].normal; }
    /// Chance per area to be searched at.
    double search_density(SurfaceIndex s) const {
        return by_area / area_ + (1.0 - by_area) / (area(s) * static_cast<double>(fronts_.size()));
    }
    void sent(const Emission& emission, Random& random, std::vector<Found>& found) const {
        const Launch launch = emission.launch(random);
        if (!(launch.light > 0.0).any()) return;
        const auto at = traced_.land(launch.surface, launch.position, launch.direction);
        if (at && (reflectance(at->surface) > 0.0).any())
            add(launch.lamp, launch.place, launch.position, at->surface, at->position, found);
    }

    void sought(Random& random, std::vector<Found>& found) const {
        const std::size_t lamp = emission_.any_lamp(random);
        const SurfaceIndex from = emission_.surface(lamp);
        SurfaceIndex to =
            fronts_[static_cast<std::size_t>(random.below(static_cast<int>(fronts_.size())))];
        if (random.chance(by_area)) {
            const auto at =
                std::upper_bound(cumulated_.begin(), cumulated_.end() - 1, random.unit() * area_);
            to = fronts_[static_cast<std::size_t>(at - cumulated_.begin())];
        }
        const Vec2 place = traced_.flat(from).draw(random);
        const PlaneFrame& frame = traced_.flat(from).frame;
        const Vec3 a = frame.lift(place),
                   b = traced_.flat(to).frame.lift(traced_.flat(to).draw(random));
        const Vec3 direction = (b - a).normalized();
        if (!(normal(from).dot(direction) > 0.0) || !(normal(to).dot(direction) < 0.0) ||
            !traced_.sees(from, a, to, b) || traced_.is_covered(from, a) ||
            traced_.is_covered(to, b))
            return;
        add(lamp, {place.x(), place.y(), direction.dot(frame.u), direction.dot(frame.v)}, a, to, b,
            found);
    }

    void add(std::size_t lamp, const Place& place, const Vec3& a, SurfaceIndex s, const Vec3& b,
             std::vector<Found>& found) const {
        const Vec3 ray = b - a;
        const double up = normal(emission_.surface(lamp)).dot(ray), down = -normal(s).dot(ray);
        const double squared = ray.squaredNorm();
        Found one{{lamp, place, 0.0, 0.0}, {s, traced_.flat(s).frame.flat(b), 0.0}};
        one.yield = luminance(emission_.intensity(lamp) * reflectance(s));
        one.sought = static_cast<double>(searches_) * emission_.chance_of(lamp) /
                     area(emission_.surface(lamp)) * search_density(s) * squared * squared /
                     (up * down);
        found.push_back(one);
    }

    const TracedScene& traced_;
    const Emission emission_;           // that has learned nothing: searches choose lamps by it
    std::size_t searches_;              // a round
    std::vector<SurfaceIndex> fronts_;  // that reflect
    std::vector<double> cumulated_;     // their areas [m²]
    double area_ = 0.0;
};

/// Light matters by the radiosity it meets, as bins of all that was found tell.
std::vector<UsefulLight> weigh(const TracedScene& traced, std::vector<Found>& found) {
    std::vector<Landed> landed;
    for (Found& one : found) {
        one.light.flux = one.landed.flux = one.yield / one.expected;
        landed.push_back(one.landed);
    }
    const Bins bins(traced, landed, {a_bin, 1e300, true});
    std::vector<double> flux(bins.size());
    const auto bin_of = [&](const Found& one) {
        return bins.bin(one.landed.surface, one.landed.place);
    };
    for (const Found& one : found) flux[bin_of(one)] += one.landed.flux;
    std::vector<UsefulLight> useful;
    for (const Found& one : found) {
        useful.push_back(one.light);
        const std::size_t bin = bin_of(one);
        if (bins.area(bin) > 0.0)
            // What others found there: one sample, however heavy, is no bright spot.
            useful.back().importance =
                one.light.flux * std::max(0.0, flux[bin] - one.light.flux) / bins.area(bin);
    }
    return useful;
}

struct Sums {
    double flux = 0.0, importance = 0.0, flux_squares = 0.0, importance_squares = 0.0;

    void add(const UsefulLight& light) {
        flux += light.flux;
        importance += light.importance;
        flux_squares += light.flux * light.flux;
        importance_squares += light.importance * light.importance;
    }
    /// As many samples of even weight would tell as much, of flux and of what matters.
    double count() const {
        if (!(importance_squares > 0.0)) return 0.0;
        return std::min(flux * flux / flux_squares, importance * importance / importance_squares);
    }
};

/// Of all samples; less if those of one lamp object are too few, though its light is no trifle, or
/// though none of it was found.
double effective_count(const TracedScene& traced, const Emission& emission,
                       std::span<const UsefulLight> useful) {
    const auto object = [&](std::size_t lamp) {
        return traced.scene().surfaces[emission.surface(lamp)].object;
    };
    std::map<ObjectIndex, Sums> of_object;
    for (std::size_t lamp = 0; lamp < emission.lamps(); ++lamp) of_object[object(lamp)];
    Sums all;
    for (const UsefulLight& light : useful) {
        all.add(light);
        of_object[object(light.lamp)].add(light);
    }
    double count = all.count();
    for (const auto& [which, sums] : of_object)
        if (!(sums.flux > 0.0) || sums.flux > trifle * all.flux)
            count = std::min(count, found_enough / a_lamp * sums.count());
    return count;
}

/// Leaves about so many samples, of even worth: most of those worth little go, the others of them
/// stand for them.
void thin(std::vector<Found>& found, std::span<const UsefulLight> useful, Random& random) {
    Sums all;
    for (const UsefulLight& light : useful) all.add(light);
    if (!(all.importance > 0.0)) return;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < found.size(); ++k) {
        const double worth =
            0.5 * useful[k].flux / all.flux + 0.5 * useful[k].importance / all.importance;
        const double stays = worth * most_kept;
        if (!random.chance(stays)) continue;
        found[kept] = found[k];
        found[kept++].yield /= std::min(1.0, stays);
    }
    found.resize(kept);
}

}  // namespace

/// Samples of all rounds are kept, each weighed by how often all of them should have found it (the
/// balance heuristic; Veach & Guibas, "Optimally combining sampling techniques", 1995).
void learn_useful_light(const TracedScene& traced, Emission& emission, std::uint64_t seed,
                        std::size_t searches) {
    if (emission.is_dark()) return;
    const Search search(traced, emission, searches);
    if (search.is_dark()) return;
    std::vector<Found> found;
    std::vector<Emission> sent;
    Random random(seed, tasks);
    double searched = 0.0, told = 0.0;
    for (int round = 0; round < rounds; ++round) {
        const bool seek = round == 0 || (round < search_rounds && told < found_enough);
        std::vector<Found> more =
            search.round(emission, seek, seed + static_cast<std::uint64_t>(round));
        sent.push_back(emission);
        const auto density = [&](const Emission& of, const Found& one) {
            return static_cast<double>(search.launches()) *
                   of.density(one.light.lamp, one.light.place);
        };
        for (Found& one : found) one.expected += density(emission, one) + (seek ? one.sought : 0.0);
        searched += seek ? 1.0 : 0.0;
        for (Found& one : more) {
            one.expected = searched * one.sought;
            for (const Emission& of : sent) one.expected += density(of, one);
        }
        found.insert(found.end(), more.begin(), more.end());
        const std::vector<UsefulLight> useful = weigh(traced, found);
        const double before = std::exchange(told, effective_count(traced, emission, useful));
        // Where plain launches tell enough at once, a guide would only make their light uneven.
        const bool plain_will_do = round == 0 && told > found_enough;
        emission.learn(useful, !plain_will_do);
        if (plain_will_do || told > plenty || (told > found_enough && told < gain * before)) break;
        thin(found, useful, random);
    }
}

}  // namespace patchlight
