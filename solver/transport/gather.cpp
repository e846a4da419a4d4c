#include "solver/transport/gather.h"

#include "solver/rays/wide.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

namespace patchlight {

namespace {

constexpr std::size_t lanes = 8;

/// Sums of C channels over a dense stretch. Memory-bound: one float and C doubles from cache a
/// term.
template <std::size_t C>
inline void dense_sum(const float* f, const std::array<const double*, 3>& b, std::size_t n,
                      double* sums) {
    double part[C][lanes] = {};
    std::size_t j = 0;
    for (; j + lanes <= n; j += lanes)
        for (std::size_t c = 0; c < C; ++c)
            for (std::size_t k = 0; k < lanes; ++k)
                part[c][k] += static_cast<double>(f[j + k]) * b[c][j + k];
    for (std::size_t c = 0; c < C; ++c) {
        double sum = ((part[c][0] + part[c][4]) + (part[c][1] + part[c][5])) +
                     ((part[c][2] + part[c][6]) + (part[c][3] + part[c][7]));
        for (std::size_t rest = j; rest < n; ++rest)
            sum += static_cast<double>(f[rest]) * b[c][rest];
        sums[c] = sum;
    }
}

PATCHLIGHT_WIDE void dense_sum_1(const float* f, const std::array<const double*, 3>& b,
                                 std::size_t n, double* sums) {
    dense_sum<1>(f, b, n, sums);
}
PATCHLIGHT_WIDE void dense_sum_3(const float* f, const std::array<const double*, 3>& b,
                                 std::size_t n, double* sums) {
    dense_sum<3>(f, b, n, sums);
}

}  // namespace

Gathered gather(const FormFactorMatrix& factors, PatchIndex i, const Field& radiosity,
                PatchIndex begin, PatchIndex end) {
    Gathered sums{};
    const std::size_t channels = radiosity.size();
    if (factors.is_dense(i)) {
        std::array<const double*, 3> b{};
        for (std::size_t c = 0; c < channels; ++c) b[c] = radiosity[c].data() + begin;
        (channels == 1 ? dense_sum_1 : dense_sum_3)(factors.dense(i).data() + begin, b, end - begin,
                                                    sums.data());
        return sums;
    }
    const auto columns = factors.columns(i);
    const auto values = factors.factors(i);
    const auto first = static_cast<std::size_t>(
        std::lower_bound(columns.begin(), columns.end(), begin) - columns.begin());
    for (std::size_t k = first; k < columns.size() && columns[k] < end; ++k)
        for (std::size_t c = 0; c < channels; ++c)
            sums[c] += static_cast<double>(values[k]) * radiosity[c][columns[k]];
    return sums;
}

Field gather_all(const FormFactorMatrix& factors, const Field& radiosity) {
    Field irradiance(radiosity.size(), std::vector<double>(factors.size()));
    const auto n = static_cast<PatchIndex>(factors.size());
    tbb::parallel_for(tbb::blocked_range<PatchIndex>(0, n, 32),
                      [&](const tbb::blocked_range<PatchIndex>& rows) {
                          for (PatchIndex i = rows.begin(); i < rows.end(); ++i) {
                              const Gathered sums = gather(factors, i, radiosity, 0, n);
                              for (std::size_t c = 0; c < radiosity.size(); ++c)
                                  irradiance[c][i] = sums[c];
                          }
                      });
    return irradiance;
}

}  // namespace patchlight
