#include "tests/bench/shown_in_bins.h"

namespace patchlight {

std::vector<double> shown_in_bins(const Scene& scene, const Solution& solution,
                                  const TracedScene& traced, const Bins& bins) {
    std::vector<double> shown(bins.size());
    const DisplayMesh& display = solution.display;
    for (std::size_t t = 0; t < display.triangles.size(); ++t) {
        const SurfaceIndex s = solution.mesh.patches[display.patch[t]].surface;
        const double exitance = luminance(scene.materials[scene.surfaces[s].material].exitance);
        std::array<Vec2, 3> corners;
        std::array<double, 3> values;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = display.triangles[t][k];
            corners[k] = traced.flat(s).frame.flat(display.positions[v]);
            values[k] = luminance(display.radiosity[v]) - exitance;
        }
        bins.integrate(s, corners, values, shown);
    }
    return shown;
}

}  // namespace patchlight
