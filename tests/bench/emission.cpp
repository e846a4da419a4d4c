#include "tests/bench/emission.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patchlight {

namespace {

constexpr double by_power = 0.5;   // share of first launches; the others evenly over lamps
constexpr double in_doubt = 0.15;  // share of launches as at first, whatever was learned
constexpr double guided_share = 0.5;
constexpr std::size_t few = 16;           // samples a lamp: too few to learn from
constexpr std::size_t enough = 40'000;    // more teach little
constexpr std::size_t to_choose = 4'000;  // by which heights are compared
constexpr std::size_t most_heights = 10;
constexpr double level = 0.9999;  // cosine between planes that are parallel [1]

}  // namespace

Emission::Emission(const TracedScene& traced) : traced_(traced) {
    const Scene& scene = traced.scene();
    double whole = 0.0;
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s) {
        const Surface& surface = scene.surfaces[s];
        const double exitance = luminance(scene.materials[surface.material].exitance);
        if (!(exitance > 0.0)) continue;
        lamps_.push_back({s, traced.flat(s).cumulated_area.back(), exitance * surface.area});
        whole += lamps_.back().power;
    }
    for (Lamp& lamp : lamps_) find_heights(lamp);
    for (Lamp& lamp : lamps_)
        lamp.plain = lamp.unlearned =
            by_power * lamp.power / whole + (1.0 - by_power) / static_cast<double>(lamps_.size());
    set_chances({});
}

/// Where light that starts at a place passes a plane above the lamp. Places a direction has are
/// moved alike, so a density stays what it is.
Place Emission::raised(const Place& place, double height) {
    if (height == 0.0) return place;
    const double along = height / std::sqrt(std::max(1e-12, 1.0 - place.tail<2>().square().sum()));
    Place moved = place;
    moved.head<2>() += along * place.tail<2>();
    return moved;
}

void Emission::find_heights(Lamp& lamp) const {
    const Scene& scene = traced_.scene();
    const Surface& own = scene.surfaces[lamp.surface];
    const double same = 1e-6 * std::sqrt(own.area);
    for (const Surface& surface : scene.surfaces) {
        if (std::abs(surface.normal.dot(own.normal)) < level) continue;
        const double height = (surface.corners[0] - own.corners[0]).dot(own.normal);
        if (height > same) lamp.heights.push_back(height);
    }
    std::sort(lamp.heights.begin(), lamp.heights.end());
    const auto last = std::unique(lamp.heights.begin(), lamp.heights.end(),
                                  [same](double a, double b) { return b - a <= same; });
    lamp.heights.erase(last, lamp.heights.end());
    if (lamp.heights.size() > most_heights) lamp.heights.resize(most_heights);
}

/// A gap in a plane is a box there, whatever the direction: the plane in which samples crowd most
/// is where the guide is learned.
void Emission::teach(Lamp& lamp, std::vector<WeightedPlace> samples) {
    const auto thinned = [&](std::size_t most, double height) {
        const std::size_t step = (samples.size() + most - 1) / most;
        std::vector<WeightedPlace> some;
        for (std::size_t k = 0; k < samples.size(); k += step)
            some.push_back({raised(samples[k].place, height), samples[k].weight});
        return some;
    };
    const auto likelihood = [&](double height) {
        std::vector<WeightedPlace> some = thinned(to_choose, height);
        return DensityTree(some).likelihood(some);
    };
    lamp.height = 0.0;
    double best = lamp.heights.empty() ? 0.0 : likelihood(0.0);
    for (const double height : lamp.heights)
        if (const double found = likelihood(height); found > best)
            best = found, lamp.height = height;
    std::vector<WeightedPlace> some = thinned(enough, lamp.height);
    lamp.guide.emplace(some);
}

/// Cumulates; `share` are those of lamps in what was useful.
void Emission::set_chances(std::span<const double> share) {
    double guided = 0.0;
    for (std::size_t k = 0; k < share.size(); ++k)
        if (lamps_[k].guide) guided += share[k];
    for (std::size_t k = 0; k < share.size(); ++k) {
        lamps_[k].guided = lamps_[k].guide ? guided_share * share[k] / guided : 0.0;
        lamps_[k].plain = in_doubt * lamps_[k].unlearned +
                          (1.0 - in_doubt - (guided > 0.0 ? guided_share : 0.0)) * share[k];
    }
    cumulated_.clear();
    double sum = 0.0;
    for (const Lamp& lamp : lamps_) cumulated_.push_back(sum += lamp.plain);
    for (const Lamp& lamp : lamps_) cumulated_.push_back(sum += lamp.guided);
}

Rgb Emission::intensity(std::size_t lamp) const {
    const Scene& scene = traced_.scene();
    return scene.materials[scene.surfaces[lamps_[lamp].surface].material].exitance /
           std::numbers::pi;
}

std::size_t Emission::any_lamp(Random& random) const {
    const auto last = cumulated_.begin() + static_cast<std::ptrdiff_t>(lamps_.size()) - 1;
    const auto found = std::upper_bound(cumulated_.begin(), last, random.unit() * *last);
    return static_cast<std::size_t>(found - cumulated_.begin());
}

Launch Emission::launch(Random& random) const {
    const double at = random.unit() * cumulated_.back();
    const auto found = std::upper_bound(cumulated_.begin(), cumulated_.end() - 1, at);
    auto k = static_cast<std::size_t>(found - cumulated_.begin());
    const bool guided = k >= lamps_.size();
    if (guided) k -= lamps_.size();
    const Lamp& lamp = lamps_[k];
    const FlatPolygon& flat = traced_.flat(lamp.surface);
    Launch launch{k, lamp.surface};
    if (guided) {
        launch.place = raised(lamp.guide->draw(random), -lamp.height);
    } else {
        const Vec2 p = flat.draw(random);
        const double radius = std::sqrt(random.unit());
        const double angle = 2.0 * std::numbers::pi * random.unit();
        launch.place = {p.x(), p.y(), radius * std::cos(angle), radius * std::sin(angle)};
    }
    const Vec2 p = launch.place.head<2>().matrix();
    const Vec2 d = launch.place.tail<2>().matrix();
    launch.position = flat.frame.lift(p);
    const double upward = 1.0 - d.squaredNorm();
    if (!(upward > 0.0) || (guided && !contains(flat.corners, p)) ||
        traced_.is_covered(lamp.surface, launch.position))
        return launch;
    launch.direction =
        d.x() * flat.frame.u + d.y() * flat.frame.v + std::sqrt(upward) * flat.frame.normal;
    launch.light = intensity(k) / density(k, launch.place);
    return launch;
}

double Emission::density(std::size_t k, const Place& place) const {
    const Lamp& lamp = lamps_[k];
    double density = lamp.plain / (lamp.area * std::numbers::pi);
    if (lamp.guide) density += lamp.guided * lamp.guide->density(raised(place, lamp.height));
    return density / cumulated_.back();
}

void Emission::learn(std::span<const UsefulLight> useful, bool guide) {
    std::vector<std::vector<WeightedPlace>> of_lamp(lamps_.size());
    std::vector<double> share(lamps_.size());
    double flux = 0.0, importance = 0.0;
    for (const UsefulLight& light : useful) {
        flux += light.flux;
        importance += light.importance;
    }
    if (!(flux > 0.0)) return;
    for (const UsefulLight& light : useful) {
        const double worth = 0.5 * light.flux / flux + 0.5 * light.importance / importance;
        share[light.lamp] += worth;
        if (guide) of_lamp[light.lamp].push_back({light.place, worth});
    }
    for (std::size_t k = 0; k < lamps_.size(); ++k)
        if (of_lamp[k].size() >= few) teach(lamps_[k], std::move(of_lamp[k]));
    set_chances(share);
}

}  // namespace patchlight
