#include "solver/display/vertex_irradiance.h"

#include <algorithm>
#include <cstddef>

namespace patchlight {
namespace {

constexpr double least_telling = 1e-4;  // reflectance below which rounding outweighs the light [1]

/// Sums over the patches round each vertex.
struct Surroundings {
    std::vector<Rgb> power;    // irradiance times area [W]
    std::vector<double> area;  // [m²]
    std::vector<MaterialIndex> material;
};

/// A quad's two triangles follow each other; a corner they share counts once.
bool is_counted(const DisplayMesh& display, std::size_t t, std::uint32_t vertex) {
    if (t == 0 || display.patch[t] != display.patch[t - 1]) return false;
    const auto& before = display.triangles[t - 1];
    return std::find(before.begin(), before.end(), vertex) != before.end();
}

Surroundings surroundings(const Scene& scene, const Solution& solution) {
    const DisplayMesh& display = solution.display;
    const std::size_t count = display.positions.size();
    Surroundings sums{std::vector<Rgb>(count, Rgb::Zero()), std::vector<double>(count, 0.0),
                      std::vector<MaterialIndex>(count, 0)};
    for (std::size_t t = 0; t < display.triangles.size(); ++t) {
        const PatchIndex i = display.patch[t];
        const Patch& patch = solution.mesh.patches[i];
        for (const std::uint32_t vertex : display.triangles[t]) {
            if (is_counted(display, t, vertex)) continue;
            sums.power[vertex] += patch.area * solution.irradiance[i];
            sums.area[vertex] += patch.area;
            sums.material[vertex] = scene.surfaces[patch.surface].material;
        }
    }
    return sums;
}

}  // namespace

std::vector<Rgb> vertex_irradiance(const Scene& scene, const Solution& solution) {
    const Surroundings sums = surroundings(scene, solution);
    std::vector<Rgb> irradiance(solution.display.positions.size(), Rgb::Zero());
    for (std::size_t k = 0; k < irradiance.size(); ++k) {
        const Material& material = scene.materials[sums.material[k]];
        const Rgb reflected = solution.display.radiosity[k] - material.exitance;
        for (Eigen::Index c = 0; c < 3; ++c) {
            const double reflectance = material.reflectance[c];
            if (reflectance >= least_telling)
                irradiance[k][c] = std::max(0.0, reflected[c] / reflectance);
            else if (sums.area[k] > 0.0)
                irradiance[k][c] = sums.power[k][c] / sums.area[k];
        }
    }
    return irradiance;
}

}  // namespace patchlight
