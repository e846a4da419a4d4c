#include "solver/form_factors/hemicube_engine.h"

#include "solver/rays/low_discrepancy.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patchlight {

namespace {

constexpr int most_sub_samples = 4;
constexpr int least_resolution = 16;
/// k² parts leave a proximity error of about (edge / distance)² / (3 k²), measured on facing
/// squares and corners: so many times edge / distance leave two percent.
constexpr double parts_by_nearness = 4.0;
constexpr double proximity = 1.0 / 3.0;
/// The near depth, as a share of the patch's edge: a neighbour nearer than that is not seen.
constexpr double nearest_seen = 1e-6;
/// Of n cells some 4 sqrt(n) lie on a patch's edge, each in error by a twelfth of its square;
/// neighbouring ones together, which makes it about twice that (measured on turned squares).
constexpr double edge_cells = 2.0 / 3.0;

double edge_length(const Patch& patch, double scale) { return std::sqrt(patch.area) * scale; }

}  // namespace

HemicubeEngine::HemicubeEngine(const Scene& scene, const PatchMesh& mesh, const RayScene& ray_scene,
                               const HemicubeSettings& settings)
    : mesh_(mesh),
      ray_scene_(ray_scene),
      settings_(settings),
      hemicube_scene_(scene, ray_scene),
      locator_(scene, mesh, ray_scene) {
    const bool chosen = settings.sub_samples == 0;
    for (int k = 1; k <= (chosen ? most_sub_samples : 1); ++k) {
        const int reduced =
            2 * static_cast<int>(std::lround(settings.resolution / std::sqrt(k) / 2));
        cells_.emplace_back(k == 1 ? settings.resolution
                                   : std::clamp(reduced,
                                                std::min(least_resolution, settings.resolution),
                                                settings.resolution));
    }
    for (PatchIndex i = 0; i < mesh.size(); ++i) {
        const SurfaceIndex s = mesh.patches[i].surface;
        samplers_.push_back(make_sampler(mesh, i, scene.surfaces[s].normal, ray_scene));
        lift_.push_back(ray_scene.lift(s));
    }
}

const HemicubeCells& HemicubeEngine::cells_for(int k) const {
    return settings_.sub_samples == 0 ? cells_[static_cast<std::size_t>(k - 1)] : cells_[0];
}

HemicubePose HemicubeEngine::pose(PatchIndex i, int k, int part) const {
    const PatchSampler& sampler = samplers_[i];
    const auto middle = [k](int n) {
        return (static_cast<float>(n) + 0.5f) / static_cast<float>(k);
    };
    const RayPoint at = k == 1 ? sampler.centre : sampler.at(middle(part % k), middle(part / k));
    HemicubePose pose;
    pose.normal = sampler.normal.cast<double>().normalized();
    pose.eye = at.cast<double>() + static_cast<double>(lift_[i]) * pose.normal;
    const std::uint64_t bits =
        mix(mix(settings_.seed, i), static_cast<std::uint64_t>(part) + 0x68656d69);
    const double angle = settings_.rotated
                             ? 2.0 * std::numbers::pi * static_cast<double>(bits >> 11) * 0x1p-53
                             : 0.0;
    const Vec3 u = sampler.tangent.cast<double>(), v = pose.normal.cross(u).normalized();
    pose.tangent = (std::cos(angle) * v.cross(pose.normal) + std::sin(angle) * v);
    pose.bitangent = pose.normal.cross(pose.tangent);
    pose.near_depth = nearest_seen * edge_length(mesh_.patches[i], ray_scene_.scale());
    return pose;
}

HemicubeEngine::Tally HemicubeEngine::look(PatchIndex i, int k) const {
    Tally tally;
    tally.share.assign(mesh_.size(), 0.0);
    tally.cells.assign(mesh_.size(), 0);
    tally.nearest = 8.0;
    const double part_share = 1.0 / (k * k);
    HemicubeView view(hemicube_scene_, cells_for(k), ray_scene_);
    for (int part = 0; part < k * k; ++part)
        tally.rays += view.look(pose(i, k, part), [&](double share, const HemicubeSight* sight) {
            const double weighted = share * part_share;
            if (!sight) {
                tally.escaped += weighted;
                return;
            }
            tally.nearest = std::min(tally.nearest, sight->distance);
            if (!sight->front) {
                tally.backs += weighted;
                return;
            }
            const Eigen::Vector3f p = sight->point.cast<float>();
            const PatchIndex j = locator_.find(sight->surface, p.x(), p.y(), p.z());
            tally.share[j] += weighted;
            ++tally.cells[j];
        });
    return tally;
}

int HemicubeEngine::wanted(PatchIndex i, double nearest) const {
    const double edge = edge_length(mesh_.patches[i], ray_scene_.scale());
    const double parts = std::min(parts_by_nearness * edge / std::max(nearest, 1e-30), 1e3);
    return std::clamp(static_cast<int>(std::lround(parts)), 1, most_sub_samples);
}

int HemicubeEngine::sub_samples(PatchIndex i) const {
    return settings_.sub_samples > 0 ? settings_.sub_samples : wanted(i, look(i, 1).nearest);
}

double HemicubeEngine::variance(PatchIndex i, PatchIndex j, int k, const Tally& tally) const {
    const double factor = tally.share[j], cells = tally.cells[j];
    const double aliasing = edge_cells * factor * factor / (cells * std::sqrt(cells));
    const Patch &from = mesh_.patches[i], &to = mesh_.patches[j];
    const double squared = std::max((to.centre - from.centre).squaredNorm(), from.area / 4.0);
    const double near = proximity * factor * std::min(1.0, from.area / squared) / (k * k);
    return aliasing + near * near;
}

void HemicubeEngine::row(PatchIndex i, FactorRow& row) const {
    row.clear();
    if (mesh_.patches[i].covered) {
        row.outside = outside(i);
        return;
    }
    int k = std::max(1, settings_.sub_samples);
    Tally tally = look(i, k);
    if (settings_.sub_samples == 0) {
        k = wanted(i, tally.nearest);
        if (k > 1) {
            row.rays += tally.rays;
            tally = look(i, k);
        }
    }
    row.rays += tally.rays;
    row.samples = k * k;
    row.outside = Outside{
        tally.backs, tally.escaped,
        static_cast<std::uint64_t>(cells_for(k).count()) * static_cast<std::uint64_t>(k * k)};
    for (PatchIndex j = 0; j < mesh_.size(); ++j)
        if (tally.cells[j] > 0) row.add(j, tally.share[j], variance(i, j, k, tally), 1.0);
}

Outside HemicubeEngine::outside(PatchIndex i) const {
    if (mesh_.patches[i].covered) return {1.0, 0.0, 0};
    FactorRow whole;
    row(i, whole);
    return *whole.outside;
}

std::vector<Vec3> HemicubeEngine::part_centres(PatchIndex i, int k) const {
    std::vector<Vec3> centres;
    for (int part = 0; part < k * k; ++part)
        centres.push_back(ray_scene_.from_ray_space(pose(i, k, part).eye));
    return centres;
}

}  // namespace patchlight
