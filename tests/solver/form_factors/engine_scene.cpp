#include "tests/solver/form_factors/engine_scene.h"

#include <algorithm>
#include <numeric>

namespace patchlight {

Scene facing_squares() {
    const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY();
    return scene_of({rectangle(Vec3::Zero(), x, y), rectangle(Vec3::UnitZ(), y, x)});
}

double row_sum(const FactorRow& row) {
    return std::accumulate(row.factors.begin(), row.factors.end(), 0.0);
}

FactorRow row_of(const FormFactorEngine& engine, PatchIndex i) {
    FactorRow row;
    engine.row(i, row);
    return row;
}

ExchangeMatrix exchange_of(const FormFactorEngine& engine, const CutScene& cut) {
    return build_exchange(engine, cut.scene, cut.mesh, [](double) { return true; });
}

double entry(const ExchangeMatrix& matrix, PatchIndex i, PatchIndex j) {
    const auto [row, column] = std::minmax(i, j);
    for (std::size_t k = matrix.start[row]; k < matrix.start[row + 1]; ++k)
        if (matrix.column[k] == column) return static_cast<double>(matrix.exchange[k]);
    return 0.0;
}

}  // namespace patchlight
