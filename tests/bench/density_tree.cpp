#include "tests/bench/density_tree.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace patchlight {

namespace {

constexpr std::size_t leaf_size = 16;  // samples
constexpr std::size_t fewest = 4;      // of half a box
constexpr int deepest = 40;
constexpr double spread = 0.08;                              // of a box's mass, evenly over it [1]
constexpr double doubt_of_all = 0.25, doubt_of_part = 0.03;  // of a box's width [1]
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

/// Where to split along an axis: between the samples in the middle, or where they leave the widest
/// gap.
struct Cut {
    int axis = -1;
    std::size_t first = 0;  // samples below
    double worth = -std::numeric_limits<double>::infinity();
};

/// Logarithm of the likelihood of its samples, spread over their box.
double worth_of(std::span<const WeightedPlace> samples) {
    const double part = mass(samples);
    return part > 0.0 ? part * (std::log(part) - Box(samples).log_volume()) : 0.0;
}

void sort_along(std::span<WeightedPlace> samples, int axis) {
    std::sort(samples.begin(), samples.end(),
              [axis](const auto& a, const auto& b) { return a.place[axis] < b.place[axis]; });
}

/// The cut that makes the samples most likely.
Cut best_cut(std::span<WeightedPlace> samples) {
    Cut best;
    for (int axis = 0; axis < 4; ++axis) {
        sort_along(samples, axis);
        std::size_t gap = fewest;
        const auto width = [&](std::size_t k) {
            return samples[k].place[axis] - samples[k - 1].place[axis];
        };
        for (std::size_t k = fewest; k + fewest <= samples.size(); ++k)
            if (width(k) > width(gap)) gap = k;
        for (const std::size_t first : {gap, samples.size() / 2}) {
            if (!(width(first) > 0.0)) continue;
            const double worth = worth_of(samples.first(first)) + worth_of(samples.subspan(first));
            if (worth > best.worth) best = {axis, first, worth};
        }
    }
    return best;
}

}  // namespace

DensityTree::DensityTree(std::span<WeightedPlace> samples) {
    const double all = std::numeric_limits<double>::infinity();
    grow(samples, Place::Constant(-all), Place::Constant(all), 0);
}

std::uint32_t DensityTree::grow(std::span<WeightedPlace> samples, const Place& low,
                                const Place& high, int depth) {
    const auto number = static_cast<std::uint32_t>(nodes_.size());
    const Box box(samples);
    // Unseen samples lie about a gap beyond the outermost that were seen. The outermost box is the
    // only one that finds what all others leave out.
    const double beyond = std::max(2.0 / static_cast<double>(samples.size()),
                                   depth == 0 ? doubt_of_all : doubt_of_part);
    const Place margin = ((box.high - box.low) * beyond).max(narrowest);
    const Node node{(box.low - margin).max(low), (box.high + margin).min(high)};
    nodes_.push_back(node);
    if (samples.size() < leaf_size || depth == deepest) return number;
    const auto [axis, half, worth] = best_cut(samples);
    if (axis < 0) return number;
    sort_along(samples, axis);
    const double border = 0.5 * (samples[half - 1].place[axis] + samples[half].place[axis]);
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
