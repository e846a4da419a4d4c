#include "tests/stability/column.h"

namespace patchlight::stability {

const std::vector<Column>& every_column() {
    static const std::vector<Column> columns{
        {"analytic", {Engine::analytic, Method::gauss_seidel}},
        {"analytic, shooting", {Engine::analytic, Method::shooting}},
        {"ray-cast", {Engine::ray_cast, Method::gauss_seidel}},
        {"ray-cast, shooting", {Engine::ray_cast, Method::shooting}},
        {"hemicube", {Engine::hemicube, Method::gauss_seidel}},
        {"hemicube, shooting", {Engine::hemicube, Method::shooting}},
        {"accuracy", {Engine::automatic, Method::automatic}, true},
    };
    return columns;
}

std::string column_name(const testing::TestParamInfo<Column>& info) {
    if (info.param.to_accuracy) return "Accuracy";
    return name_of(info.param.way.engine) + (info.param.shoots() ? "Shooting" : "GaussSeidel");
}

SolveSettings settings_for(const Column& column, const HandSet& by_hand) {
    SolveSettings settings;
    if (column.to_accuracy) {
        settings.accuracy = default_accuracy;
        return settings;
    }
    settings = settings_of(column.way);
    settings.patch_size = by_hand.patch_size;
    settings.tolerance = by_hand.tolerance;
    set_rays(settings, by_hand.rays);
    return settings;
}

Solution solve(const Scene& scene, const Column& column, const HandSet& by_hand,
               std::uint64_t seed) {
    SolveSettings settings = settings_for(column, by_hand);
    settings.seed = seed;
    return patchlight::solve(scene, settings);
}

}  // namespace patchlight::stability
