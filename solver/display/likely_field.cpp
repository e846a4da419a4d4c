#include "solver/display/likely_field.h"

#include <oneapi/tbb/parallel_for.h>

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

constexpr std::size_t part = 1024;  // that one thread does at a time

template <typename At>
void in_parts(std::size_t count, const At& at) {
    tbb::parallel_for(std::size_t{0}, (count + part - 1) / part, [&](std::size_t p) {
        for (std::size_t k = p * part; k < std::min(count, (p + 1) * part); ++k) at(k);
    });
}

/// Sums by parts, so that they do not hang on who does which.
template <typename At>
Rgb sum_of(std::size_t count, const At& at) {
    std::vector<Rgb> sums((count + part - 1) / part, Rgb::Zero());
    tbb::parallel_for(std::size_t{0}, sums.size(), [&](std::size_t p) {
        for (std::size_t k = p * part; k < std::min(count, (p + 1) * part); ++k) sums[p] += at(k);
    });
    Rgb sum = Rgb::Zero();
    for (const Rgb& of_part : sums) sum += of_part;
    return sum;
}

class Smoothing {
  public:
    Smoothing(const RefinementTree& tree, const NoisyField& field, double least_miss)
        : tree_(tree), field_(field), least_square_(least_miss * least_miss) {
        spread_variance();
        bind();
        loosen();
        list_uses();
    }
    std::vector<Rgb> solve() const;

  private:
    void spread_variance();
    void bind();
    void loosen();
    std::vector<double> excess() const;
    std::vector<double> evened(const std::vector<double>& of_bonds) const;
    void list_uses();
    double diagonal(std::size_t v) const;
    std::vector<Rgb> pulls(const std::vector<Rgb>& u) const;
    Rgb product(std::size_t v, const std::vector<Rgb>& u, const std::vector<Rgb>& pull) const;
    bool is_bound(std::uint32_t v) const { return bond_of_[v] != RefinementTree::none; }

    const RefinementTree& tree_;
    const NoisyField& field_;
    double least_square_;
    std::vector<double> variance_;  // per vertex, evened out [W²/m⁴]
    std::vector<Bond> bonds_;
    std::vector<std::uint32_t> bond_of_;  // per vertex
    std::vector<std::uint32_t> known_;    // vertices
    struct Use {
        std::uint32_t bond = 0;
        double weight = 0.0;
    };
    std::vector<std::size_t> first_use_;  // per vertex, and the end
    std::vector<Use> uses_;
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
    for (std::uint32_t v = 0; v < field_.known.size(); ++v)
        if (field_.known[v]) known_.push_back(v);
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

/// Which bonds each vertex is part of.
void Smoothing::list_uses() {
    first_use_.assign(tree_.vertices().size() + 1, 0);
    for (const Bond& bond : bonds_)
        for (std::size_t k = 0; k < bond.count; ++k) ++first_use_[bond.vertex[k] + 1];
    for (std::size_t v = 1; v < first_use_.size(); ++v) first_use_[v] += first_use_[v - 1];
    uses_.resize(first_use_.back());
    std::vector<std::size_t> next(first_use_.begin(), first_use_.end() - 1);
    for (std::uint32_t b = 0; b < bonds_.size(); ++b)
        for (std::size_t k = 0; k < bonds_[b].count; ++k)
            uses_[next[bonds_[b].vertex[k]]++] = {b, bonds_[b].weight[k]};
}

double Smoothing::diagonal(std::size_t v) const {
    double sum = 1.0 / variance_[v];
    for (std::size_t n = first_use_[v]; n < first_use_[v + 1]; ++n)
        sum += uses_[n].weight * uses_[n].weight * bonds_[uses_[n].bond].tightness;
    return sum;
}

/// What all bonds pull, for product().
std::vector<Rgb> Smoothing::pulls(const std::vector<Rgb>& u) const {
    std::vector<Rgb> pull(bonds_.size());
    in_parts(bonds_.size(),
             [&](std::size_t b) { pull[b] = bonds_[b].tightness * bonds_[b].of(u); });
    return pull;
}

/// The system times u at one vertex.
Rgb Smoothing::product(std::size_t v, const std::vector<Rgb>& u,
                       const std::vector<Rgb>& pull) const {
    Rgb sum = u[v] / variance_[v];
    for (std::size_t n = first_use_[v]; n < first_use_[v + 1]; ++n)
        sum += uses_[n].weight * pull[uses_[n].bond];
    return sum;
}

/// Conjugate gradients on what changes, each channel by itself, scaled by the diagonal.
std::vector<Rgb> Smoothing::solve() const {
    const std::size_t n = field_.values.size(), known = known_.size();
    std::vector<double> scale(n);
    std::vector<Rgb> u(field_.values.begin(), field_.values.end()), residual(n), step(n), along(n);
    std::vector<Rgb> pull = pulls(u);
    Rgb power = sum_of(known, [&](std::size_t k) {
        const std::uint32_t v = known_[k];
        scale[v] = 1.0 / diagonal(v);
        residual[v] = field_.values[v] / variance_[v] - product(v, u, pull);
        step[v] = scale[v] * residual[v];
        return Rgb(residual[v] * step[v]);
    });
    const Rgb first = power;
    for (int round = 0; round < most_steps; ++round) {
        if ((power <= small_enough * small_enough * first).all()) break;
        pull = pulls(step);
        const Rgb curvature = sum_of(known, [&](std::size_t k) {
            const std::uint32_t v = known_[k];
            along[v] = product(v, step, pull);
            return Rgb(step[v] * along[v]);
        });
        const Rgb length = (curvature > 0.0).select(power / curvature.max(1e-300), 0.0);
        const Rgb next = sum_of(known, [&](std::size_t k) {
            const std::uint32_t v = known_[k];
            u[v] += length * step[v];
            residual[v] -= length * along[v];
            return Rgb(scale[v] * residual[v] * residual[v]);
        });
        const Rgb kept = (power > 0.0).select(next / power.max(1e-300), 0.0);
        in_parts(known, [&](std::size_t k) {
            step[known_[k]] = scale[known_[k]] * residual[known_[k]] + kept * step[known_[k]];
        });
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
