#include "tests/solver/view_factor_table.h"

#include "solver/solve_plan.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace patchlight {

double ViewFactorTable::row_sum(std::size_t i) const {
    return std::accumulate(factors[i].begin(), factors[i].end(), 0.0);
}

std::size_t ViewFactorTable::at(const std::string& name) const {
    const auto found = std::find(groups.names.begin(), groups.names.end(), name);
    if (found == groups.names.end()) throw std::out_of_range(name);
    return static_cast<std::size_t>(found - groups.names.begin());
}

ViewFactorTable view_factors(const Scene& scene, const SolveSettings& settings, Grouping grouping,
                             const Observer& observe) {
    const ViewFactorSolver solver(scene, settings, grouping);
    ViewFactorTable table;
    table.groups = solver.groups();
    const std::size_t n = table.groups.areas.size();
    table.factors.assign(n, std::vector<double>(n, 0.0));
    table.errors = table.factors;
    table.report = solver.find(
        [&](const GroupFactors& row) {
            for (std::size_t k = 0; k < row.to.size(); ++k) {
                table.factors.at(row.from).at(row.to[k]) = row.factors[k];
                table.errors[row.from][row.to[k]] = row.errors[k];
            }
        },
        observe);
    return table;
}

SolveSettings with_little_memory(const Scene& scene, double patch_size) {
    SolveSettings settings;
    settings.patch_size = patch_size;
    SolveSettings rows = plan_solve(scene, settings).settings;
    rows.method = Method::shooting;
    const PatchMesh mesh = make_patches(scene, find_mesh_lines(scene), patch_size);
    settings.memory_limit = estimate_memory(
        scene, std::max(mesh.size(), estimate_patch_count(scene, patch_size)), rows);
    return settings;
}

}  // namespace patchlight
