#include "tests/bench/density_tree.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace patchlight {

namespace {

constexpr std::size_t leaf_size = 12;  // samples
constexpr int deepest = 40;
constexpr double spread = 0.08;  // of a box's mass, evenly over it [1]
constexpr double narrowest = 1e-9;

struct Box {
    Place low = Place::Constant(std::numeric_limits<double>::infinity());
    Place high = -low;

    explicit Box(std::span<const WeightedPlace> samples) {
        for (const WeightedPlace& sample : samples) {
            low = low.min(sample.place);
            high = high.max(sample.place);
        }
    }
    double log_volume() const { return (high - low).max(narrowest).log().sum(); }
};

double mass(std::span<const WeightedPlace> samples) {
    double sum = 0.0;
    for (const WeightedPlace& sample : samples) sum += sample.weight;
    return sum;
}

}  // namespace

DensityTree::DensityTree(std::span<WeightedPlace> samples) {
    const double all = std::numeric_limits<double>::infinity();
    grow(samples, Place::Constant(-all), Place::Constant(all), 0);
}

/// Splits in the middle of the samples, along the axis that leaves the densest halves: the most
/// likely of the four histograms.
std::uint32_t DensityTree::grow(std::span<WeightedPlace> samples, const Place& low,
                                const Place& high, int depth) {
    const auto number = static_cast<std::uint32_t>(nodes_.size());
    const Box box(samples);
    // Unseen samples lie about a gap beyond the outermost that were seen.
    const Place margin =
        ((box.high - box.low) * (2.0 / static_cast<double>(samples.size()))).max(narrowest);
    Node node{(box.low - margin).max(low), (box.high + margin).min(high)};
    nodes_.push_back(node);
    if (samples.size() < 2 * leaf_size || depth == deepest) return number;
    const std::size_t half = samples.size() / 2;
    const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(half);
    double best = std::numeric_limits<double>::infinity();
    int axis = -1;
    const auto split = [&](int along) {
        std::nth_element(samples.begin(), middle, samples.end(), [&](const auto& a, const auto& b) {
            return a.place[along] < b.place[along];
        });
    };
    for (int along = 0; along < 4; ++along) {
        if (!(box.high[along] - box.low[along] > 4.0 * narrowest)) continue;
        split(along);
        const double volume =
            Box(samples.first(half)).log_volume() + Box(samples.subspan(half)).log_volume();
        if (volume < best) best = volume, axis = along;
    }
    if (axis < 0) return number;
    split(axis);
    const Box lower(samples.first(half)), upper(samples.subspan(half));
    const double border = 0.5 * (lower.high[axis] + upper.low[axis]);
    const Place outer_low = node.low, outer_high = node.high;  // a child stays within
    Place first_high = outer_high, second_low = outer_low;
    first_high[axis] = second_low[axis] = border;
    const double whole = mass(samples), first_mass = mass(samples.first(half));
    const std::uint32_t first = grow(samples.first(half), outer_low, first_high, depth + 1);
    const std::uint32_t second = grow(samples.subspan(half), second_low, outer_high, depth + 1);
    nodes_[first].share = whole > 0.0 ? first_mass / whole : 0.5;
    nodes_[second].share = 1.0 - nodes_[first].share;
    nodes_[number].second = second;
    nodes_[number].axis = axis;
    nodes_[number].border = border;
    return number;
}

Place DensityTree::draw(Random& random) const {
    std::uint32_t number = 0;
    while (nodes_[number].second != 0 && !random.chance(spread))
        number = random.chance(nodes_[number + 1].share) ? number + 1 : nodes_[number].second;
    const Node& node = nodes_[number];
    Place place;
    for (int k = 0; k < 4; ++k) place[k] = random.uniform(node.low[k], node.high[k]);
    return place;
}

double DensityTree::density(const Place& place) const {
    double reaching = 1.0, sum = 0.0;
    for (std::uint32_t number = 0;;) {
        const Node& node = nodes_[number];
        if ((place < node.low || place > node.high).any()) return sum;
        const double volume = (node.high - node.low).prod();
        if (node.second == 0) return sum + reaching / volume;
        sum += spread * reaching / volume;
        number = place[node.axis] < node.border ? number + 1 : node.second;
        reaching *= (1.0 - spread) * nodes_[number].share;
    }
}

double DensityTree::likelihood(std::span<const WeightedPlace> samples) const {
    double sum = 0.0;
    for (const WeightedPlace& sample : samples)
        if (sample.weight > 0.0) sum += sample.weight * std::log(density(sample.place));
    return sum / mass(samples);
}

}  // namespace patchlight
