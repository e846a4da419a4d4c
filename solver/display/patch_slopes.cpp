#include "solver/display/patch_slopes.h"

#include "solver/display/vertex_radiosity.h"

#include <Eigen/Geometry>

namespace patchlight {

namespace {

using Slope = Eigen::Matrix3d;  // rows: channels; columns: world axes

/// Mean slope of a patch's display triangles, weighted with their areas.
struct MeanSlope {
    Slope sum = Slope::Zero();
    double area = 0.0;

    void add(const std::array<Vec3, 3>& p, const std::array<Rgb, 3>& b) {
        const Vec3 e1 = p[1] - p[0], e2 = p[2] - p[0];
        const Vec3 normal = e1.cross(e2);
        const double twice = normal.norm();
        if (!(twice > 0.0)) return;
        // Gradients of the two barycentric coordinates.
        const Vec3 g1 = e2.cross(normal) / (twice * twice), g2 = normal.cross(e1) / (twice * twice);
        const Slope slope =
            (b[1] - b[0]).matrix() * g1.transpose() + (b[2] - b[0]).matrix() * g2.transpose();
        sum += 0.5 * twice * slope;
        area += 0.5 * twice;
    }
};

}  // namespace

void add_sloped(const Scene& scene, const PatchMesh& mesh, const std::vector<Rgb>& radiosity,
                const std::vector<double>& hidden, FieldTable& table) {
    const DisplayMesh display = make_display(scene, mesh, radiosity, hidden);
    std::vector<MeanSlope> slopes(mesh.size());
    for (std::size_t t = 0; t < display.triangles.size(); ++t) {
        const auto [a, b, c] = display.triangles[t];
        slopes[display.patch[t]].add(
            {display.positions[a], display.positions[b], display.positions[c]},
            {display.radiosity[a], display.radiosity[b], display.radiosity[c]});
    }
    for (PatchIndex i = 0; i < mesh.size(); ++i) {
        const MeanSlope& slope = slopes[i];
        table.add_linear(i, radiosity[i],
                         slope.area > 0.0 ? Slope(slope.sum / slope.area) : Slope::Zero());
    }
}

}  // namespace patchlight
