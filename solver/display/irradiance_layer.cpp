#include "solver/display/irradiance_layer.h"

#include "solver/display/curved_mean.h"
#include "solver/display/likely_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace patchlight {

namespace {

constexpr double root_share = 0.25;  // of the range of its corners, a root is expected to miss [1]
constexpr double unseen_share =
    0.08;                             // of their value: corners alike do not tell what lies between
constexpr double decay = 1.0 / 3.0;   // of what is missed, by each cut: 1/4 is smooth, 1/2 a kink
constexpr double highest_peak = 6.0;  // that may be missed anywhere, over the root mean square [1]
constexpr double smallest_peak = 5e-5;  // of all area: smaller ones hardly anybody will meet [1]
constexpr double beyond_noise = 9.0;    // its mean square: hardly ever chance [1]
constexpr int most_follows = 4;  // times that all elements are looked at for finer ones beside
constexpr double by_chance =
    1.0;  // of the mean noise, that three squares of it often go beyond [1]
constexpr double bilinear_noise = 4.0 / 9.0;  // mean over an element beside that at corners [1]
constexpr double variance_decay = 1.44;       // see indirect_gather.cpp
constexpr double mean_square = 0.5;  // of the miss over an element beside that at its middles [1]

}  // namespace

/// Square of what interpolation misses at a vertex, and how much of it noise makes on average.
IrradianceLayer::Miss IrradianceLayer::miss(std::uint32_t vertex, const Rgb& expected, double noise,
                                            const Rgb& reflectance) const {
    const double missed = luminance(reflectance * (value_[vertex] - expected));
    return {missed * missed, noise + variance_[vertex]};
}

double IrradianceLayer::root_miss(const TreeElement& element, const Rgb& reflectance) const {
    double low = 1e300, high = -1e300;
    for (const std::uint32_t v : element.vertices) {
        const double b = luminance(reflectance * value_[v]);
        low = std::min(low, b);
        high = std::max(high, b);
    }
    const double miss = std::max(root_share * (high - low), unseen_share * high);
    return mean_square * element.area * miss * miss;
}

void IrradianceLayer::grow(const RefinementTree& tree) {
    value_.resize(tree.vertices().size(), Rgb::Zero());
    variance_.resize(tree.vertices().size(), 0.0);
    known_.resize(tree.vertices().size(), false);
}

/// Gathers at what vertices of the elements' corners are not known yet.
bool IrradianceLayer::learn(const RefinementTree& tree, std::span<const std::uint32_t> elements,
                            const Gather& gather) {
    grow(tree);
    std::vector<std::uint32_t> wanted;
    for (const std::uint32_t e : elements)
        for (const std::uint32_t v : tree.elements()[e].vertices)
            if (!known_[v]) {
                known_[v] = true;
                wanted.push_back(v);
            }
    if (wanted.empty()) return true;
    const std::vector<Gathered> values = gather(wanted);
    std::size_t got = 0;
    for (std::size_t k = 0; k < wanted.size(); ++k) {
        value_[wanted[k]] = values[k].value;
        variance_[wanted[k]] = values[k].variance;
        known_[wanted[k]] = values[k].known;
        got += values[k].known ? 1 : 0;
    }
    gathered_ += got;
    return got == wanted.size();
}

void IrradianceLayer::add_children(const RefinementTree& tree, std::uint32_t element,
                                   const Rgb& reflectance, std::vector<Leaf>& leaves) const {
    const TreeElement& parent = tree.elements()[element];
    const std::size_t n = parent.corner_count();
    const auto& v = parent.vertices;
    std::array<Miss, 4> at_edge{};  // in the middle of each
    Rgb expected_inside = Rgb::Zero();
    double variance = 0.0;  // mean of the corners'
    for (std::size_t k = 0; k < n; ++k) variance += variance_[v[k]] / static_cast<double>(n);
    for (std::size_t k = 0; k < n; ++k) {
        const std::uint32_t m = tree.middle(parent, k), a = v[k], b = v[(k + 1) % n];
        const auto& row = tree.vertices()[m].row;
        const Rgb expected = edge_mean(row, a, b, value_);
        at_edge[k] = miss(m, expected, edge_noise(row.has_value()) * variance, reflectance);
        expected_inside += 0.5 * expected - 0.25 * value_[a];
    }
    const std::uint32_t c = tree.centre(parent);
    const Miss inside =
        c == RefinementTree::none
            ? Miss{}
            : miss(c, expected_inside, quad_noise(parent.level > 0) * variance, reflectance);
    for (std::size_t k = 0; k < 4; ++k) {
        const std::uint32_t child = parent.first_child + static_cast<std::uint32_t>(k);
        std::array<Miss, 3> near{at_edge[0], at_edge[1], at_edge[2]};  // triangle in the middle
        if (n == 4)
            near = {inside, at_edge[k], at_edge[(k + 3) % 4]};
        else if (k < 3)
            near = {at_edge[k], at_edge[(k + 2) % 3], at_edge[k]};
        Leaf leaf{child, 0.0, 0.0, 0.0};
        for (const Miss& one : near) {
            leaf.miss += (one.square - one.noise) / 3.0;  // sums of it are right: it may be below 0
            leaf.sure += std::max(0.0, one.square - beyond_noise * one.noise) / 3.0;
            leaf.doubt += by_chance * one.noise / 3.0;
        }
        const double scale = mean_square * decay * decay * tree.elements()[child].area;
        leaf.miss *= scale;
        leaf.sure *= scale;
        leaf.doubt *= scale;
        leaves.push_back(leaf);
    }
}

bool IrradianceLayer::is_cut(const RefinementTree& tree, const TreeElement& element) const {
    for (std::uint32_t k = 0; k < 4; ++k)
        for (const std::uint32_t v : tree.elements()[element.first_child + k].vertices)
            if (!known(v)) return false;
    return true;
}

/// What points of a display were found to miss, its element is expected to miss.
void IrradianceLayer::look_closer(const RefinementTree& tree, const CloserLook& closer) {
    constexpr std::uint32_t none = RefinementTree::none;
    std::vector<std::uint32_t> number(tree.elements().size(), none);
    for (std::uint32_t k = 0; k < leaves_.size(); ++k) number[leaves_[k].element] = k;
    closer.each(
        tree, value_, [&](std::uint32_t e) { return number[e] != none; },
        [&](std::uint32_t e, double square) {
            Leaf& leaf = leaves_[number[e]];
            const double miss = square * tree.elements()[e].area;
            leaf.miss = std::max(leaf.miss, miss);
            leaf.sure = std::max(leaf.sure, miss);
        });
}

/// An edge of a shadow that was found in one element goes on in those beside it.
void IrradianceLayer::follow_neighbours(const RefinementTree& tree, const Rule& rule,
                                        std::vector<std::uint32_t>& marked,
                                        std::vector<Leaf>& kept) const {
    const auto is_known = [&](std::uint32_t v) { return known(v); };
    std::vector<Leaf> left;
    for (const Leaf& leaf : kept) {
        const TreeElement& element = tree.elements()[leaf.element];
        if (element.level < rule.most_levels && tree.is_cut_twice(element, is_known))
            marked.push_back(leaf.element);
        else
            left.push_back(leaf);
    }
    kept = std::move(left);
}

/// Of scrambled sequences the variance falls with the power `variance_decay` of their length; both
/// parts tell what that of the whole is.
bool IrradianceLayer::join(const Gather& gather, double share) {
    likely_.clear();
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t v = 0; v < value_.size(); ++v)
        if (known_[v]) vertices.push_back(v);
    const std::vector<Gathered> more = gather(vertices);
    const double of_first = 0.5 * std::pow(1.0 - share, variance_decay),
                 of_more = 0.5 * std::pow(share, variance_decay);
    bool is_whole = true;
    for (std::size_t k = 0; k < more.size(); ++k) {
        const std::uint32_t v = vertices[k];
        is_whole = is_whole && more[k].known;
        if (!more[k].known) continue;
        value_[v] = (1.0 - share) * value_[v] + share * more[k].value;
        variance_[v] = of_first * variance_[v] + of_more * more[k].variance;
    }
    return is_whole;
}

bool IrradianceLayer::refine(RefinementTree& tree, const std::vector<Rgb>& reflectance,
                             const Rule& rule, const Gather& gather) {
    likely_.clear();
    const auto of = [&](std::uint32_t e) -> const Rgb& {
        return reflectance[tree.elements()[e].patch];
    };
    if (leaves_.empty()) {
        std::vector<std::uint32_t> roots;
        for (std::uint32_t e = 0; e < tree.elements().size(); ++e)
            if (tree.elements()[e].level == 0) roots.push_back(e);
        lacks_roots_ = !learn(tree, roots, gather);
        if (lacks_roots_) return false;
        for (const std::uint32_t e : roots) {
            const double miss = root_miss(tree.elements()[e], of(e));
            leaves_.push_back({e, miss, miss, 0.0});
        }
    }
    const double budget = rule.target * rule.target;
    double area = 0.0;
    for (const TreeElement& element : tree.elements())
        if (element.level == 0) area += element.area;
    const double peak = highest_peak * highest_peak * budget / area;
    const auto must_cut = [&](const TreeElement& element) {
        return element.level < rule.most_levels && rule.must_cut(element);
    };
    int follows = rule.follow ? most_follows : 0;
    for (;;) {
        if (rule.closer && !rule.closer->empty()) look_closer(tree, *rule.closer);
        double total = 0.0;
        for (const Leaf& leaf : leaves_) total += leaf.miss;
        expected_miss_ = std::sqrt(std::max(0.0, total));
        if (gathered_ >= rule.most_vertices) return true;
        const double share = total <= budget ? std::numeric_limits<double>::infinity()
                                             : budget / static_cast<double>(leaves_.size());
        std::vector<std::uint32_t> marked;
        std::vector<Leaf> kept;
        for (const Leaf& leaf : leaves_) {
            const TreeElement& element = tree.elements()[leaf.element];
            const bool is_peak =
                element.area > smallest_peak * area && leaf.sure > element.area * peak;
            const bool misses = leaf.miss > std::max(share, leaf.doubt) || is_peak;
            if ((misses && element.level < rule.most_levels) || must_cut(element))
                marked.push_back(leaf.element);
            else
                kept.push_back(leaf);
        }
        if (marked.empty() && follows-- > 0) follow_neighbours(tree, rule, marked, kept);
        if (marked.empty()) return true;
        std::vector<std::uint32_t> children;
        for (const std::uint32_t e : marked) {
            tree.split(e);
            for (std::uint32_t k = 0; k < 4; ++k)
                children.push_back(tree.elements()[e].first_child + k);
        }
        if (!learn(tree, children, gather)) return false;
        for (const std::uint32_t e : marked) add_children(tree, e, of(e), kept);
        leaves_ = std::move(kept);
    }
}

double IrradianceLayer::noise(const RefinementTree& tree) const {
    double sum = 0.0;
    for (const Leaf& leaf : leaves_) {
        const TreeElement& element = tree.elements()[leaf.element];
        for (std::size_t k = 0; k < element.corner_count(); ++k)
            sum += bilinear_noise * element.area * variance_[element.vertices[k]] /
                   static_cast<double>(element.corner_count());
    }
    return std::sqrt(sum);
}

void IrradianceLayer::smooth(const RefinementTree& tree, const std::vector<Rgb>& reflectance,
                             double least_miss) {
    grow(tree);
    likely_ = likely_field(tree, {value_, variance_, known_, reflectance}, least_miss);
}

std::vector<Rgb> IrradianceLayer::at_all(const RefinementTree& tree) const {
    std::vector<Rgb> values(tree.vertices().size(), Rgb::Zero());
    for (std::uint32_t v = 0; v < values.size(); ++v) {
        const TreeVertex& vertex = tree.vertices()[v];
        if (known(v))
            values[v] = v < likely_.size() ? likely_[v] : value_[v];
        else if (vertex.parent_count > 0)
            values[v] = curved_mean(tree, vertex, values);
    }
    return values;
}

}  // namespace patchlight
