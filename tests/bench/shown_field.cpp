#include "tests/bench/shown_field.h"

#include "solver/scene/light.h"

#include <oneapi/tbb/parallel_for.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace patchlight {

namespace {

constexpr std::size_t lattice = 320;

std::size_t cell(double x) {
    return static_cast<std::size_t>(
        std::clamp(x * static_cast<double>(lattice), 0.0, static_cast<double>(lattice - 1)));
}

/// Weights of a triangle's corners at a point of its plane.
Vec3 weights(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal, const Vec3& p) {
    const double whole = (b - a).cross(c - a).dot(normal);
    const double u = (c - b).cross(p - b).dot(normal) / whole,
                 v = (a - c).cross(p - c).dot(normal) / whole;
    return {u, v, 1.0 - u - v};
}

}  // namespace

ShownField::ShownField(const Scene& scene, const Solution& solution)
    : of_surface_(scene.surfaces.size()) {
    for (const Surface& surface : scene.surfaces) normal_.push_back(surface.normal);
    const DisplayMesh& display = solution.display;
    for (std::size_t t = 0; t < display.triangles.size(); ++t) {
        const SurfaceIndex s = solution.mesh.patches[display.patch[t]].surface;
        const double exitance = luminance(scene.materials[scene.surfaces[s].material].exitance);
        std::array<Corner, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = display.triangles[t][k];
            corners[k] = {display.positions[v], luminance(display.radiosity[v]) - exitance};
        }
        of_surface_[s].push_back(corners);
    }
}

double ShownField::at(SurfaceIndex s, const Vec3& p) const {
    double best = -1e300, value = 0.0;
    for (const auto& [a, b, c] : of_surface_[s]) {
        const Vec3 w = weights(a.position, b.position, c.position, normal_[s], p);
        const double inside = w.minCoeff();
        if (!(inside > best)) continue;
        best = inside;
        value = w.dot(Vec3(a.reflected, b.reflected, c.reflected));
        if (inside >= 0.0) break;
    }
    return value;
}

ShownLattices::ShownLattices(const Scene& scene, const ShownField& shown, const RayScene& rays)
    : sheets_(scene.surfaces.size()) {
    tbb::parallel_for(std::size_t{0}, sheets_.size(), [&](std::size_t s) {
        const auto& corners = scene.surfaces[s].corners;
        const Vec3 e1 = corners[1] - corners[0], e2 = corners[3] - corners[0];
        const Vec3 u = e1 / e1.squaredNorm(), v = e2 / e2.squaredNorm();
        Sheet& sheet = sheets_[s];
        sheet.origin = rays.to_ray_space(corners[0]);
        sheet.u = (u / rays.scale()).cast<float>();
        sheet.v = (v / rays.scale()).cast<float>();
        sheet.values.resize(lattice * lattice);
        for (const auto& triangle : shown.of_surface_[s]) {
            Vec3 low = Vec3::Constant(1e300), high = -low;  // in u and v; the third is not used
            for (const auto& corner : triangle) {
                const Vec3 from = corner.position - corners[0];
                const Vec3 at(from.dot(u), from.dot(v), 0.0);
                low = low.cwiseMin(at);
                high = high.cwiseMax(at);
            }
            const auto& [a, b, c] = triangle;
            for (std::size_t j = cell(low.y()); j <= cell(high.y()); ++j)
                for (std::size_t i = cell(low.x()); i <= cell(high.x()); ++i) {
                    const Vec3 p = corners[0] + (static_cast<double>(i) + 0.5) / lattice * e1 +
                                   (static_cast<double>(j) + 0.5) / lattice * e2;
                    const Vec3 w =
                        weights(a.position, b.position, c.position, scene.surfaces[s].normal, p);
                    if (w.minCoeff() >= -1e-9)
                        sheet.values[j * lattice + i] =
                            w.dot(Vec3(a.reflected, b.reflected, c.reflected));
                }
        }
    });
}

double ShownLattices::at(SurfaceIndex s, const RayPoint& p) const {
    const Sheet& sheet = sheets_[s];
    const RayPoint from = p - sheet.origin;
    return sheet.values[cell(from.dot(sheet.v)) * lattice + cell(from.dot(sheet.u))];
}

}  // namespace patchlight
