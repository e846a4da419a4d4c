#include "solver/display/vertex_radiosity.h"

#include "solver/display/smooth_groups.h"
#include "solver/scene/polygon.h"

#include <Eigen/LU>

#include <algorithm>

namespace patchlight {

namespace {

constexpr double mostly_hidden =
    0.95;                          // of a patch: what it says of its vertices does not count [1]
constexpr double overshoot = 1.0;  // of the neighbourhood's range, beyond it [1]
constexpr double on_one_line = 1e-12;  // squared spread off a line over that along it, at most [1]

using Slope = Eigen::Matrix<double, 3, 3>;  // rows: channels; columns: world axes

/// Of a matrix that is symmetric and has no negative eigenvalue: its inverse, or that along the one
/// direction that it knows.
Eigen::Matrix2d pseudo_inverse(const Eigen::Matrix2d& moments) {
    const double squared_trace = moments.trace() * moments.trace();
    if (moments.determinant() > on_one_line * squared_trace) return moments.inverse();
    if (squared_trace > 0.0) return moments / squared_trace;
    return Eigen::Matrix2d::Zero();
}

struct Fitter {
    const PatchMesh& mesh;
    const SmoothGroups& groups;
    const std::vector<Rgb>& radiosity;
    const std::vector<double>& hidden;

    bool counts(PatchIndex i) const { return hidden[i] < mostly_hidden; }

    /// Patches that share a smooth corner with patch i, itself left out.
    std::vector<PatchIndex> neighbours(PatchIndex i) const {
        std::vector<PatchIndex> found;
        for (const std::uint32_t corner : groups.of_patch[i])
            for (const PatchIndex j : groups.corners[corner].patches)
                if (j != i && counts(j)) found.push_back(j);
        std::sort(found.begin(), found.end());
        found.erase(std::unique(found.begin(), found.end()), found.end());
        return found;
    }

    Slope slope(const Scene& scene, PatchIndex i) const {
        const Vec3& normal = scene.surfaces[mesh.patches[i].surface].normal;
        const PlaneFrame frame = frame_of(mesh.patches[i].centre, normal);
        Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
        Eigen::Matrix<double, 2, 3> right = Eigen::Matrix<double, 2, 3>::Zero();
        Rgb total = Rgb::Zero();  // squared differences
        for (const PatchIndex j : neighbours(i)) {
            const Vec2 away = frame.flat(mesh.patches[j].centre);
            const double weight = 1.0 / away.squaredNorm();
            const Rgb difference = radiosity[j] - radiosity[i];
            moments += weight * away * away.transpose();
            right += weight * away * difference.matrix().transpose();
            total += weight * difference.square();
        }
        // Neighbours on one line tell the slope along it alone.
        const Eigen::Matrix<double, 2, 3> flat = pseudo_inverse(moments) * right;
        Slope slope = (frame.u * flat.row(0) + frame.v * flat.row(1)).transpose();
        for (int c = 0; c < 3; ++c) {  // as much of it as the neighbours agree on
            const double explained = flat.col(c).dot(right.col(c));
            const double agreement =
                total[c] > 0.0 ? std::clamp(explained / total[c], 0.0, 1.0) : 0.0;
            slope.row(c) *= agreement * agreement;
        }
        return slope;
    }
};

}  // namespace

DisplayMesh make_display(const Scene& scene, const PatchMesh& mesh,
                         const std::vector<Rgb>& radiosity, const std::vector<double>& hidden) {
    const SmoothGroups groups = find_smooth_groups(scene, mesh);
    const Fitter fitter{mesh, groups, radiosity, hidden};
    std::vector<Slope> slopes(mesh.size(), Slope::Zero());
    std::vector<Rgb> lowest = radiosity, highest = radiosity;  // of each patch and its neighbours
    for (PatchIndex i = 0; i < mesh.size(); ++i) {
        if (mesh.patches[i].covered || !fitter.counts(i)) continue;
        slopes[i] = fitter.slope(scene, i);
        for (const PatchIndex j : fitter.neighbours(i)) {
            lowest[i] = lowest[i].min(radiosity[j]);
            highest[i] = highest[i].max(radiosity[j]);
        }
    }
    DisplayMesh display;
    for (const SmoothCorner& corner : groups.corners) {
        const Vec3& position = mesh.vertices[corner.vertex];
        const bool any = std::any_of(corner.patches.begin(), corner.patches.end(),
                                     [&](PatchIndex i) { return fitter.counts(i); });
        Rgb sum = Rgb::Zero(), low = Rgb::Constant(1e300), high = Rgb::Zero();
        double weights = 0.0;
        for (const PatchIndex i : corner.patches) {
            if (any && !fitter.counts(i)) continue;
            const double weight = mesh.patches[i].area;
            sum +=
                weight * (radiosity[i] + (slopes[i] * (position - mesh.patches[i].centre)).array());
            weights += weight;
            low = low.min(lowest[i]);
            high = high.max(highest[i]);
        }
        const Rgb slack = overshoot * (high - low);
        const Rgb lower = (low - slack).max(0.0), upper = high + slack;
        display.positions.push_back(position);
        display.radiosity.push_back((sum / weights).max(lower).min(upper));
    }
    for (PatchIndex i = 0; i < mesh.size(); ++i) {
        if (mesh.patches[i].covered) continue;
        const auto& corner = groups.of_patch[i];
        display.triangles.push_back({corner[0], corner[1], corner[2]});
        display.patch.push_back(i);
        if (mesh.patches[i].is_triangle()) continue;
        display.triangles.push_back({corner[0], corner[2], corner[3]});
        display.patch.push_back(i);
    }
    return display;
}

}  // namespace patchlight
