#include "solver/accuracy/field_difference.h"

#include "solver/rays/low_discrepancy.h"

#include <oneapi/tbb/parallel_for.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace patchlight {

std::vector<ComparedPoint> spread_points(const Solution& solution, std::size_t count) {
    const DisplayMesh& display = solution.display;
    std::vector<double> area;  // cumulated [m²]
    for (const auto& [a, b, c] : display.triangles) {
        const Vec3& corner = display.positions[a];
        const Vec3 twice = (display.positions[b] - corner).cross(display.positions[c] - corner);
        area.push_back((area.empty() ? 0.0 : area.back()) + 0.5 * twice.norm());
    }
    std::vector<ComparedPoint> points;
    if (area.empty() || !(area.back() > 0.0)) return points;
    constexpr std::uint32_t seed = 0x706f696e;
    const SobolPoints sobol(count);
    for (std::size_t k = 0; k < count; ++k) {
        const double share = static_cast<double>(sobol.at(0, k, seed)) / static_cast<double>(count);
        const double at =
            area.back() * (static_cast<double>(k) / static_cast<double>(count) + share);
        const auto found = std::upper_bound(area.begin(), area.end() - 1, at);
        const auto t = static_cast<std::size_t>(found - area.begin());
        // Turk, "Generating Random Points in Triangles", 1990
        const double root = std::sqrt(static_cast<double>(sobol.at(1, k, seed + 1))),
                     v = static_cast<double>(sobol.at(2, k, seed + 2));
        const auto& [a, b, c] = display.triangles[t];
        points.push_back({solution.mesh.patches[display.patch[t]].surface,
                          (1.0 - root) * display.positions[a] +
                              root * (1.0 - v) * display.positions[b] +
                              root * v * display.positions[c]});
    }
    return points;
}

std::vector<double> reflected_at(const Scene& scene, const DisplayedField& field,
                                 std::span<const ComparedPoint> points) {
    std::vector<double> reflected(points.size());
    tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t k) {
        const Surface& surface = scene.surfaces[points[k].surface];
        reflected[k] = luminance(field.radiosity(points[k].surface, points[k].position) -
                                 scene.materials[surface.material].exitance);
    });
    return reflected;
}

std::optional<double> relative_difference(std::span<const double> a, std::span<const double> b) {
    double difference = 0.0, norm = 0.0;
    for (std::size_t k = 0; k < b.size(); ++k) {
        difference += (a[k] - b[k]) * (a[k] - b[k]);
        norm += b[k] * b[k];
    }
    if (!(norm > 0.0)) return std::nullopt;
    return std::sqrt(difference / norm);
}

std::optional<double> relative_difference(std::span<const SensorReport> a,
                                          std::span<const SensorReport> b) {
    if (a.size() != b.size()) return std::nullopt;
    double worst = 0.0, most = 0.0;
    for (std::size_t k = 0; k < b.size(); ++k) {
        const double right = luminance(b[k].irradiance);
        worst = std::max(worst, std::abs(luminance(a[k].irradiance) - right));
        most = std::max(most, right);
    }
    if (!(most > 0.0)) return std::nullopt;
    return worst / most;
}

}  // namespace patchlight
