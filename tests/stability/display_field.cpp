#include "tests/stability/display_field.h"

#include <Eigen/Geometry>

#include <array>

namespace patchlight::stability {

std::optional<double> shown_at(const Solution& solution, SurfaceIndex s, const Vec3& point) {
    constexpr double rim = -1e-9;  // of barycentric coordinates: points on an edge belong to both
    const DisplayMesh& display = solution.display;
    for (std::size_t t = 0; t < display.triangles.size(); ++t) {
        if (solution.mesh.patches[display.patch[t]].surface != s) continue;
        const auto& v = display.triangles[t];
        const std::array<Vec3, 3> p{display.positions[v[0]], display.positions[v[1]],
                                    display.positions[v[2]]};
        const Vec3 normal = (p[1] - p[0]).cross(p[2] - p[0]);
        std::array<double, 3> weight{};
        bool holds = normal.squaredNorm() > 0.0;
        for (std::size_t k = 0; k < 3 && holds; ++k) {
            const Vec3 &a = p[(k + 1) % 3], &b = p[(k + 2) % 3];
            weight[k] = (b - a).cross(point - a).dot(normal) / normal.squaredNorm();
            holds = weight[k] >= rim;
        }
        if (!holds) continue;
        double value = 0.0;
        for (std::size_t k = 0; k < 3; ++k) value += weight[k] * display.radiosity[v[k]][0];
        return value;
    }
    return std::nullopt;
}

}  // namespace patchlight::stability
