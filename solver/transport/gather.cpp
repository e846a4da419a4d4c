#include "solver/transport/gather.h"

#include "solver/rays/wide.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cstring>

namespace patchlight {

namespace {

constexpr std::size_t lanes = 8;
constexpr std::size_t ahead = 512;  // factors fetched early: four rows at once outrun the hardware

using Rows = std::array<const float*, rows_together>;
using Channels = std::array<const double*, 3>;

using Doubles = double __attribute__((vector_size(lanes * sizeof(double))));
using Floats = float __attribute__((vector_size(lanes * sizeof(float))));

/// Sums of C channels over the same stretch of R dense rows: sums[r * 3 + c].
template <std::size_t R, std::size_t C>
inline __attribute__((always_inline)) void dense_sum(const Rows& f, const Channels& b,
                                                     std::size_t n, double* sums) {
    Doubles part[R][C] = {};
    std::size_t j = 0;
    for (; j + lanes <= n; j += lanes) {
        Doubles radiosity[C];
        for (std::size_t c = 0; c < C; ++c) std::memcpy(&radiosity[c], b[c] + j, sizeof(Doubles));
        for (std::size_t r = 0; r < R; ++r) {
            Floats row;
            std::memcpy(&row, f[r] + j, sizeof(Floats));
            __builtin_prefetch(f[r] + j + ahead);  // past the end it does nothing
            const Doubles factors = __builtin_convertvector(row, Doubles);
            for (std::size_t c = 0; c < C; ++c) part[r][c] += factors * radiosity[c];
        }
    }
    for (std::size_t r = 0; r < R; ++r)
        for (std::size_t c = 0; c < C; ++c) {
            const Doubles p = part[r][c];
            double sum = ((p[0] + p[4]) + (p[1] + p[5])) + ((p[2] + p[6]) + (p[3] + p[7]));
            for (std::size_t rest = j; rest < n; ++rest)
                sum += static_cast<double>(f[r][rest]) * b[c][rest];
            sums[r * 3 + c] = sum;
        }
}

PATCHLIGHT_WIDE void dense_sum_1_1(const Rows& f, const Channels& b, std::size_t n, double* s) {
    dense_sum<1, 1>(f, b, n, s);
}
PATCHLIGHT_WIDE void dense_sum_1_3(const Rows& f, const Channels& b, std::size_t n, double* s) {
    dense_sum<1, 3>(f, b, n, s);
}
PATCHLIGHT_WIDE void dense_sum_4_1(const Rows& f, const Channels& b, std::size_t n, double* s) {
    dense_sum<4, 1>(f, b, n, s);
}
PATCHLIGHT_WIDE void dense_sum_4_3(const Rows& f, const Channels& b, std::size_t n, double* s) {
    dense_sum<4, 3>(f, b, n, s);
}

Channels channels_from(const Field& radiosity, PatchIndex begin) {
    Channels b{};
    for (std::size_t c = 0; c < radiosity.size(); ++c) b[c] = radiosity[c].data() + begin;
    return b;
}

}  // namespace

Gathered gather(const FormFactorMatrix& factors, PatchIndex i, const Field& radiosity,
                PatchIndex begin, PatchIndex end) {
    Gathered sums{};
    const std::size_t channels = radiosity.size();
    if (factors.is_dense(i)) {
        const Rows row{factors.dense(i).data() + begin};
        (channels == 1 ? dense_sum_1_1 : dense_sum_1_3)(row, channels_from(radiosity, begin),
                                                        end - begin, sums.data());
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

std::array<Gathered, rows_together> gather_some(const FormFactorMatrix& factors, PatchIndex i,
                                                PatchIndex last, const Field& radiosity,
                                                PatchIndex begin, PatchIndex end) {
    std::array<Gathered, rows_together> sums{};
    const PatchIndex count = last - i;
    bool together = count == rows_together;
    for (PatchIndex r = 0; r < count; ++r) together = together && factors.is_dense(i + r);
    if (!together) {
        for (PatchIndex r = 0; r < count; ++r)
            sums[r] = gather(factors, i + r, radiosity, begin, end);
        return sums;
    }
    Rows rows;
    for (PatchIndex r = 0; r < rows_together; ++r) rows[r] = factors.dense(i + r).data() + begin;
    (radiosity.size() == 1 ? dense_sum_4_1 : dense_sum_4_3)(rows, channels_from(radiosity, begin),
                                                            end - begin, sums[0].data());
    return sums;
}

void for_rows_together(PatchIndex first, PatchIndex last,
                       const std::function<void(PatchIndex, PatchIndex)>& visit) {
    const PatchIndex groups = (last - first + rows_together - 1) / rows_together;
    tbb::parallel_for(tbb::blocked_range<PatchIndex>(0, groups, 8),
                      [&](const tbb::blocked_range<PatchIndex>& range) {
                          for (PatchIndex g = range.begin(); g < range.end(); ++g)
                              visit(first + g * rows_together,
                                    std::min(last, first + (g + 1) * rows_together));
                      });
}

Field gather_all(const FormFactorMatrix& factors, const Field& radiosity) {
    Field irradiance(radiosity.size(), std::vector<double>(factors.size()));
    const auto n = static_cast<PatchIndex>(factors.size());
    for_rows_together(0, n, [&](PatchIndex first, PatchIndex last) {
        const auto sums = gather_some(factors, first, last, radiosity, 0, n);
        for (PatchIndex i = first; i < last; ++i)
            for (std::size_t c = 0; c < radiosity.size(); ++c)
                irradiance[c][i] = sums[i - first][c];
    });
    return irradiance;
}

}  // namespace patchlight
