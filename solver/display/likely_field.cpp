#include "solver/display/likely_field.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace patchlight {

namespace {

constexpr int most_steps = 40;
constexpr int excess_passes = 2;       // means over elements of what bonds miss beyond the noise
constexpr double small_enough = 1e-3;  // of the residual at first [1]

/// u at a vertex less what is expected of it, as a sum over vertices; the first is the vertex.
struct Bond {
    std::array<std::uint32_t, 13> vertex{};
    std::array<double, 13> weight{};
    std::size_t count = 0;
    double tightness = 0.0;  // 1/τ² [m⁴/W²]

    void add(std::uint32_t v, double w) {
        vertex[count] = v;
        weight[count++] = w;
    }
    Rgb of(std::span<const Rgb> u) const {
        Rgb sum = Rgb::Zero();
        for (std::size_t k = 0; k < count; ++k) sum += weight[k] * u[vertex[k]];
        return sum;
    }
};

class Smoothing {
  public:
    Smoothing(const RefinementTree& tree, const NoisyField& field, double least_miss)
        : tree_(tree), field_(field), least_square_(least_miss * least_miss) {
        spread_variance();
        bind();
        loosen();
    }
    std::vector<Rgb> solve() const;

  private:
    void spread_variance();
    void bind();
    void loosen();
    std::vector<double> excess() const;
    std::vector<double> evened(const std::vector<double>& of_bonds) const;
    std::vector<Rgb> times_system(const std::vector<Rgb>& u) const;
    bool is_bound(std::uint32_t v) const { return bond_of_[v] != RefinementTree::none; }

    const RefinementTree& tree_;
    const NoisyField& field_;
    double least_square_;
    std::vector<double> variance_;  // per vertex, evened out [W²/m⁴]
    std::vector<Bond> bonds_;
    std::vector<std::uint32_t> bond_of_;  // per vertex
};

/// The variance of one vertex is itself a guess from two halves: means with those about it.
void Smoothing::spread_variance() {
    const std::size_t n = tree_.vertices().size();
    variance_.assign(n, 0.0);
    std::vector<double> sum(n, 0.0), count(n, 0.0);
    for (const TreeElement& element : tree_.elements()) {
        double mean = 0.0;
        bool all = true;
        const std::size_t corners = element.corner_count();
        for (std::size_t k = 0; k < corners; ++k) {
            all = all && field_.known[element.vertices[k]];
            mean += field_.variance[element.vertices[k]] / static_cast<double>(corners);
        }
        if (!all) continue;
        for (std::size_t k = 0; k < corners; ++k) {
            sum[element.vertices[k]] += mean;
            count[element.vertices[k]] += 1.0;
        }
    }
    double whole = 0.0, known = 0.0;
    for (std::size_t v = 0; v < n; ++v)
        if (count[v] > 0.0) {
            variance_[v] = sum[v] / count[v];
            whole += variance_[v];
            known += 1.0;
        }
    constexpr double hardly_any = 1e-6;  // of the mean: no value is taken for certain
    for (double& variance : variance_)
        variance = std::max(variance, hardly_any * whole / std::max(1.0, known) + 1e-300);
}

void Smoothing::bind() {
    bond_of_.assign(tree_.vertices().size(), RefinementTree::none);
    const auto known = [&](std::uint32_t v) { return field_.known[v]; };
    for (std::uint32_t v = 0; v < tree_.vertices().size(); ++v) {
        const TreeVertex& vertex = tree_.vertices()[v];
        if (vertex.parent_count == 0 || !known(v)) continue;
        Bond bond;
        bond.add(v, 1.0);
        bool all = true;
        for (std::size_t k = 0; k < vertex.parent_count; ++k) {
            all = all && known(vertex.parents[k]);
            bond.add(vertex.parents[k], -0.5);
            if (vertex.parent_count == 2) continue;
            for (std::size_t end = 0; end < 2; ++end) {
                const std::uint32_t corner = tree_.vertices()[vertex.parents[k]].parents[end];
                all = all && known(corner);
                bond.add(corner, 0.125);
            }
        }
        if (vertex.row) {
            constexpr std::array<double, 3> second{0.125, -0.25, 0.125};
            for (std::size_t k = 0; k < 3; ++k) {
                all = all && known((*vertex.row)[k]);
                bond.add((*vertex.row)[k], second[k]);
            }
        }
        if (!all) continue;
        bond_of_[v] = static_cast<std::uint32_t>(bonds_.size());
        bonds_.push_back(bond);
    }
}

/// What each bond misses beyond the noise, squared; less than nothing by chance.
std::vector<double> Smoothing::excess() const {
    std::vector<double> excess(bonds_.size(), 0.0);
    for (std::size_t b = 0; b < bonds_.size(); ++b) {
        const Bond& bond = bonds_[b];
        const PatchIndex patch = tree_.vertices()[bond.vertex[0]].patch;
        const double missed = luminance(field_.reflectance[patch] * bond.of(field_.values));
        double noise = 0.0;
        for (std::size_t k = 0; k < bond.count; ++k)
            noise += bond.weight[k] * bond.weight[k] * variance_[bond.vertex[k]];
        excess[b] = missed * missed - noise;
    }
    return excess;
}

/// Each bond's own is one square: means over the middles of the elements it belongs to.
std::vector<double> Smoothing::evened(const std::vector<double>& of_bonds) const {
    std::vector<double> sum(bonds_.size(), 0.0), count(bonds_.size(), 0.0);
    for (const TreeElement& element : tree_.elements()) {
        if (element.is_leaf()) continue;
        std::array<std::uint32_t, 5> middles{};
        std::size_t n = 0;
        const auto take = [&](std::uint32_t v) {
            if (v != RefinementTree::none && is_bound(v)) middles[n++] = bond_of_[v];
        };
        for (std::size_t k = 0; k < element.corner_count(); ++k) take(tree_.middle(element, k));
        take(tree_.centre(element));
        double mean = 0.0;
        for (std::size_t k = 0; k < n; ++k) mean += of_bonds[middles[k]] / static_cast<double>(n);
        for (std::size_t k = 0; k < n; ++k) {
            sum[middles[k]] += mean;
            count[middles[k]] += 1.0;
        }
    }
    for (std::size_t b = 0; b < sum.size(); ++b)
        sum[b] = count[b] > 0.0 ? sum[b] / count[b] : of_bonds[b];
    return sum;
}

/// τ² of each bond.
void Smoothing::loosen() {
    std::vector<double> missed = excess();
    for (int pass = 0; pass < excess_passes; ++pass) missed = evened(missed);
    for (std::size_t b = 0; b < bonds_.size(); ++b)
        bonds_[b].tightness = 1.0 / (std::max(missed[b], 0.0) + least_square_ + 1e-300);
}

std::vector<Rgb> Smoothing::times_system(const std::vector<Rgb>& u) const {
    std::vector<Rgb> product(u.size());
    for (std::size_t v = 0; v < u.size(); ++v) product[v] = u[v] / variance_[v];
    for (const Bond& bond : bonds_) {
        const Rgb pull = bond.tightness * bond.of(u);
        for (std::size_t k = 0; k < bond.count; ++k)
            product[bond.vertex[k]] += bond.weight[k] * pull;
    }
    return product;
}

/// Conjugate gradients on what changes, each channel by itself, scaled by the diagonal.
std::vector<Rgb> Smoothing::solve() const {
    const std::size_t n = field_.values.size();
    std::vector<double> diagonal(n);
    for (std::size_t v = 0; v < n; ++v) diagonal[v] = 1.0 / variance_[v];
    for (const Bond& bond : bonds_)
        for (std::size_t k = 0; k < bond.count; ++k)
            diagonal[bond.vertex[k]] += bond.weight[k] * bond.weight[k] * bond.tightness;
    std::vector<Rgb> u(field_.values.begin(), field_.values.end()), residual(n), step(n);
    std::vector<Rgb> product = times_system(u);
    Rgb power = Rgb::Zero(), first = Rgb::Zero();
    for (std::size_t v = 0; v < n; ++v) {
        residual[v] = field_.values[v] / variance_[v] - product[v];
        step[v] = residual[v] / diagonal[v];
        power += residual[v] * step[v];
    }
    first = power;
    for (int k = 0; k < most_steps; ++k) {
        if ((power <= small_enough * small_enough * first).all()) break;
        product = times_system(step);
        Rgb along = Rgb::Zero();
        for (std::size_t v = 0; v < n; ++v) along += step[v] * product[v];
        const Rgb length = (along > 0.0).select(power / along.max(1e-300), 0.0);
        Rgb next = Rgb::Zero();
        for (std::size_t v = 0; v < n; ++v) {
            u[v] += length * step[v];
            residual[v] -= length * product[v];
            next += residual[v] * residual[v] / diagonal[v];
        }
        const Rgb kept = (power > 0.0).select(next / power.max(1e-300), 0.0);
        for (std::size_t v = 0; v < n; ++v) step[v] = residual[v] / diagonal[v] + kept * step[v];
        power = next;
    }
    return u;
}

}  // namespace

std::vector<Rgb> likely_field(const RefinementTree& tree, const NoisyField& field,
                              double least_miss) {
    return Smoothing(tree, field, least_miss).solve();
}

}  // namespace patchlight
