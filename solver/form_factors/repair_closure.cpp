#include "solver/form_factors/repair_closure.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace patchlight {

namespace {

constexpr int most_passes = 20;    // a pass may push entries to their bounds; the next goes without
constexpr int most_steps = 200;    // of conjugate gradients
constexpr double closed = 1e-9;    // largest closure defect to stop at [1]
constexpr double overfull = 1e-5;  // more than float entries and quadrature make of a full row [1]
constexpr double regularisation =
    1e-9;  // of a row's variance: pairs that see only each other leave λ undetermined

/// The uncertain entries of both halves, by rows.
struct Uncertain {
    std::vector<std::size_t> start;
    std::vector<PatchIndex> column;
    std::vector<float> variance;
    std::vector<double> diagonal;  // 0: the row cannot change, or cannot be closed

    explicit Uncertain(const ExchangeMatrix& matrix)
        : start(matrix.size() + 1, 0), diagonal(matrix.size(), 0.0) {
        const std::size_t n = matrix.size();
        for_each(matrix, [&](PatchIndex i, PatchIndex j, float v) {
            ++start[i + 1], ++start[j + 1];
            diagonal[i] += static_cast<double>(v), diagonal[j] += static_cast<double>(v);
        });
        for (std::size_t i = 0; i < n; ++i) start[i + 1] += start[i];
        column.resize(start[n]);
        variance.resize(start[n]);
        std::vector<std::size_t> next(start.begin(), start.end() - 1);
        for_each(matrix, [&](PatchIndex i, PatchIndex j, float v) {
            column[next[i]] = j, variance[next[i]++] = v;
            column[next[j]] = i, variance[next[j]++] = v;
        });
        for (std::size_t i = 0; i < n; ++i) {
            const double outside = matrix.backs_variance[i] + matrix.escaped_variance[i];
            diagonal[i] =
                diagonal[i] * (1.0 + regularisation) + outside * matrix.area[i] * matrix.area[i];
        }
        leave_out_hopeless_rows(matrix);
    }
    /// Rows that no allowed change closes, as where surfaces pass through each other, and those of
    /// which less is uncertain than float entries round: the wall of a hall, of a box that it
    /// hardly sees. To ask for it all the same would push their neighbours away without end.
    void leave_out_hopeless_rows(const ExchangeMatrix& matrix) {
        std::vector<double> least(matrix.size(), 0.0), most(matrix.size(), 0.0);
        for (PatchIndex i = 0; i < matrix.size(); ++i)
            for (std::size_t k = matrix.start[i]; k < matrix.start[i + 1]; ++k) {
                const bool fixed = matrix.variance[k] == 0.0f;
                const double low = fixed ? static_cast<double>(matrix.exchange[k]) : 0.0;
                const double high =
                    fixed ? low
                          : static_cast<double>(std::max(matrix.ceiling[k], matrix.exchange[k]));
                for (const PatchIndex row : {i, matrix.column[k]})
                    least[row] += low, most[row] += high;
            }
        for (std::size_t i = 0; i < matrix.size(); ++i) {
            const double a = matrix.area[i], slack = 1e-6 * a;
            for (const auto& [share, uncertainty] :
                 {std::pair(matrix.backs[i], matrix.backs_variance[i]),
                  {matrix.escaped[i], matrix.escaped_variance[i]}}) {
                least[i] += uncertainty > 0.0 ? 0.0 : share * a;
                most[i] += uncertainty > 0.0 ? a : share * a;
            }
            if (least[i] > a + slack || most[i] < a - slack || most[i] - least[i] < slack)
                diagonal[i] = 0.0;
        }
    }
    template <typename Visit>
    static void for_each(const ExchangeMatrix& matrix, const Visit& visit) {
        for (PatchIndex i = 0; i < matrix.size(); ++i)
            for (std::size_t k = matrix.start[i]; k < matrix.start[i + 1]; ++k)
                if (matrix.variance[k] > 0.0f) visit(i, matrix.column[k], matrix.variance[k]);
    }
    void multiply(const std::vector<double>& x, std::vector<double>& y) const {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, x.size(), 64),
                          [&](const tbb::blocked_range<std::size_t>& rows) {
                              for (std::size_t i = rows.begin(); i < rows.end(); ++i) {
                                  double sum = diagonal[i] * x[i];
                                  for (std::size_t k = start[i]; k < start[i + 1]; ++k)
                                      sum += static_cast<double>(variance[k]) * x[column[k]];
                                  y[i] = sum;
                              }
                          });
    }
};

double dot(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

std::vector<double> closure_defect(const ExchangeMatrix& matrix) {
    std::vector<double> defect(matrix.size());
    for (std::size_t i = 0; i < matrix.size(); ++i)
        defect[i] = matrix.area[i] * (1.0 - matrix.backs[i] - matrix.escaped[i]);
    for (PatchIndex i = 0; i < matrix.size(); ++i)
        for (std::size_t k = matrix.start[i]; k < matrix.start[i + 1]; ++k) {
            defect[i] -= static_cast<double>(matrix.exchange[k]);
            defect[matrix.column[k]] -= static_cast<double>(matrix.exchange[k]);
        }
    return defect;
}

double worst(const ExchangeMatrix& matrix, const std::vector<double>& defect,
             const Uncertain& system) {
    double most = 0.0;
    for (std::size_t i = 0; i < defect.size(); ++i)
        if (system.diagonal[i] > 0.0) most = std::max(most, std::abs(defect[i]) / matrix.area[i]);
    return most;
}

/// Conjugate gradients with the diagonal as preconditioner (Hestenes & Stiefel, 1952).
std::vector<double> solve(const ExchangeMatrix& matrix, const Uncertain& system,
                          std::vector<double> residual) {
    const std::size_t n = residual.size();
    std::vector<double> x(n, 0.0), z(n), product(n);
    const auto precondition = [&] {
        for (std::size_t i = 0; i < n; ++i) {
            if (!(system.diagonal[i] > 0.0)) residual[i] = 0.0;  // nothing in this row can change
            z[i] = system.diagonal[i] > 0.0 ? residual[i] / system.diagonal[i] : 0.0;
        }
    };
    precondition();
    std::vector<double> direction = z;
    double energy = dot(residual, z);
    for (int step = 0;
         step < most_steps && energy > 0.0 && worst(matrix, residual, system) > 0.1 * closed;
         ++step) {
        system.multiply(direction, product);
        const double curvature = dot(direction, product);
        if (!(curvature > 0.0)) break;
        const double length = energy / curvature;
        for (std::size_t i = 0; i < n; ++i) {
            x[i] += length * direction[i];
            residual[i] -= length * product[i];
        }
        precondition();
        const double next = dot(residual, z);
        for (std::size_t i = 0; i < n; ++i) direction[i] = z[i] + next / energy * direction[i];
        energy = next;
    }
    return x;
}

/// Adds the change; an entry that meets a bound stays there and counts as exact from then on.
void add_change(ExchangeMatrix& matrix, const std::vector<double>& multiplier) {
    for (PatchIndex i = 0; i < matrix.size(); ++i)
        for (std::size_t k = matrix.start[i]; k < matrix.start[i + 1]; ++k) {
            const double v = static_cast<double>(matrix.variance[k]);
            if (v == 0.0) continue;
            const double wanted = static_cast<double>(matrix.exchange[k]) +
                                  v * (multiplier[i] + multiplier[matrix.column[k]]);
            const double allowed = std::clamp(wanted, 0.0, static_cast<double>(matrix.ceiling[k]));
            if (allowed != wanted) matrix.variance[k] = 0.0f;
            matrix.exchange[k] = static_cast<float>(allowed);
        }
    const auto move = [](double& share, double& variance, double change) {
        const double wanted = share + variance * change;
        share = std::clamp(wanted, 0.0, 1.0);
        if (share != wanted) variance = 0.0;
    };
    for (std::size_t i = 0; i < matrix.size(); ++i) {
        const double change = multiplier[i] * matrix.area[i];
        move(matrix.backs[i], matrix.backs_variance[i], change);
        move(matrix.escaped[i], matrix.escaped_variance[i], change);
    }
}

/// No patch sends on more than it has: pairs of a row that sums to more than 1 in spite of all are
/// shrunk, both halves alike, so that solvers stay stable. What is then missing shows as closure.
void shrink_overfull_rows(ExchangeMatrix& matrix) {
    std::vector<double> sum(matrix.size(), 0.0);
    for (PatchIndex i = 0; i < matrix.size(); ++i)
        for (std::size_t k = matrix.start[i]; k < matrix.start[i + 1]; ++k)
            for (const PatchIndex row : {i, matrix.column[k]})
                sum[row] += static_cast<double>(matrix.exchange[k]) / matrix.area[row];
    const auto share = [&](PatchIndex i) { return sum[i] > 1.0 + overfull ? 1.0 / sum[i] : 1.0; };
    for (PatchIndex i = 0; i < matrix.size(); ++i)
        for (std::size_t k = matrix.start[i]; k < matrix.start[i + 1]; ++k) {
            const double least = std::min(share(i), share(matrix.column[k]));
            if (least < 1.0)
                matrix.exchange[k] =
                    static_cast<float>(least * static_cast<double>(matrix.exchange[k]));
        }
}

void close_rows(ExchangeMatrix& matrix) {
    for (int pass = 0; pass < most_passes; ++pass) {
        const Uncertain system(matrix);
        const std::vector<double> defect = closure_defect(matrix);
        if (worst(matrix, defect, system) <= (pass == 0 ? closed : 1e-7))
            return;  // float entries round to 6e-8
        add_change(matrix, solve(matrix, system, defect));
    }
}

}  // namespace

void repair_closure(ExchangeMatrix& matrix) {
    close_rows(matrix);
    shrink_overfull_rows(matrix);
}

}  // namespace patchlight
