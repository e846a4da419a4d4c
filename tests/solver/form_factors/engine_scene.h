#pragma once

#include "solver/form_factors/exchange_matrix.h"
#include "tests/solver/scenes.h"

namespace patchlight {

/// A cut scene and its rays, which engines refer to.
struct EngineScene {
    EngineScene(const Scene& scene, double patch_size)
        : cut(patchlight::cut(scene, patch_size)), rays(cut.scene, cut.lines.overlaps) {}
    CutScene cut;
    RayScene rays;
};

/// Two facing unit squares at distance 1.
Scene facing_squares();

double row_sum(const FactorRow& row);
FactorRow row_of(const FormFactorEngine& engine, PatchIndex i);

/// The matrix of an engine, all of it.
ExchangeMatrix exchange_of(const FormFactorEngine& engine, const CutScene& cut);
/// H_ij, 0 if it is not there.
double entry(const ExchangeMatrix& matrix, PatchIndex i, PatchIndex j);

}  // namespace patchlight
