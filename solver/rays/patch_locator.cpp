#include "solver/rays/patch_locator.h"

#include "solver/scene/polygon.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace patchlight {

namespace {
constexpr double parallelogram = 1e-7;  // of its size: largest misfit of the fourth corner [1]
constexpr double finer = 4.0;           // cells along a mean patch: most lie within one
constexpr float slack = 4e-3f;          // of a cell, for rounding
}  // namespace

PatchLocator::PatchLocator(const Scene& scene, const PatchMesh& mesh, const RayScene& rays)
    : cells_(scene.surfaces.size()), shapes_(mesh.size()) {
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s) {
        Cells& cells = cells_[s];
        cells.first = mesh.first_of_surface[s];
        const PatchIndex end = mesh.first_of_surface[s + 1];
        cells.single = end - cells.first == 1;
        if (cells.single || fit_grid(cells, scene.surfaces[s], rays.frame(s), mesh.grid[s], rays))
            continue;
        list_patches(cells, s, scene.surfaces[s], mesh, end, rays);
    }
    list_starts_.push_back(static_cast<std::uint32_t>(lists_.size()));
}

void PatchLocator::set_axes(Cells& cells, const Vec3& u, const Vec3& v) {
    cells.ux = static_cast<float>(u.x()), cells.uy = static_cast<float>(u.y()),
    cells.uz = static_cast<float>(u.z());
    cells.vx = static_cast<float>(v.x()), cells.vy = static_cast<float>(v.y()),
    cells.vz = static_cast<float>(v.z());
}

bool PatchLocator::fit_grid(Cells& cells, const Surface& surface, FrameIndex frame,
                            const std::array<std::uint32_t, 2>& grid, const RayScene& rays) const {
    if (grid[0] == 0) return false;
    const Vec3 u = (surface.corners[1] - surface.corners[0]) * rays.scale();
    const Vec3 v = (surface.corners[3] - surface.corners[0]) * rays.scale();
    const Vec3 misfit = (surface.corners[2] - surface.corners[0]) * rays.scale() - u - v;
    if (misfit.norm() > parallelogram * (u.norm() + v.norm())) return false;
    const RayPoint origin = rays.to_ray_space(surface.corners[0], frame);
    cells.ox = origin.x(), cells.oy = origin.y(), cells.oz = origin.z();
    const Vec3 normal = u.cross(v);
    const Vec3 dual_u = v.cross(normal), dual_v = normal.cross(u);
    set_axes(cells, dual_u * (grid[0] / dual_u.dot(u)), dual_v * (grid[1] / dual_v.dot(v)));
    cells.nu = static_cast<std::int32_t>(grid[0]);
    cells.nv = static_cast<std::int32_t>(grid[1]);
    return true;
}

void PatchLocator::list_patches(Cells& cells, SurfaceIndex s, const Surface& surface,
                                const PatchMesh& mesh, PatchIndex end, const RayScene& rays) {
    const PlaneFrame frame = frame_of(surface.corners[0], surface.normal);
    Eigen::AlignedBox2d box;
    for (const Vec3& p : surface.corners) box.extend(frame.flat(p));
    const double count = end - cells.first;
    const double edge = std::sqrt(box.volume() / count) / finer;
    const Vec2 size = box.sizes();
    cells.listed = true;
    cells.nu =
        static_cast<std::int32_t>(std::clamp(std::ceil(size.x() / edge), 1.0, finer * count));
    cells.nv =
        static_cast<std::int32_t>(std::clamp(std::ceil(size.y() / edge), 1.0, finer * count));
    const Vec2 per_metre(cells.nu / size.x(), cells.nv / size.y());
    const RayPoint origin = rays.to_ray_space(frame.lift(box.min()), rays.frame(s));
    cells.ox = origin.x(), cells.oy = origin.y(), cells.oz = origin.z();
    set_axes(cells, frame.u * (per_metre.x() / rays.scale()),
             frame.v * (per_metre.y() / rays.scale()));
    std::vector<std::vector<PatchIndex>> over(static_cast<std::size_t>(cells.nu) *
                                              static_cast<std::size_t>(cells.nv));
    for (PatchIndex p = cells.first; p < end; ++p) {
        std::array<Vec2, 4> corners;
        Eigen::AlignedBox2f reach;
        for (std::size_t k = 0; k < 4; ++k) {
            corners[k] = (frame.flat(mesh.vertices[mesh.patches[p].vertices[k]]) - box.min())
                             .cwiseProduct(per_metre);
            reach.extend(corners[k].cast<float>());
        }
        shapes_[p] = lines_of(corners);
        for (std::int32_t j = clamp(static_cast<std::int32_t>(reach.min().y() - slack), cells.nv);
             j <= clamp(static_cast<std::int32_t>(reach.max().y() + slack), cells.nv); ++j)
            for (std::int32_t i =
                     clamp(static_cast<std::int32_t>(reach.min().x() - slack), cells.nu);
                 i <= clamp(static_cast<std::int32_t>(reach.max().x() + slack), cells.nu); ++i)
                over[static_cast<std::size_t>(j * cells.nu + i)].push_back(p);
    }
    cells.first_list = static_cast<std::uint32_t>(list_starts_.size());
    for (const auto& patches : over) {
        list_starts_.push_back(static_cast<std::uint32_t>(lists_.size()));
        lists_.insert(lists_.end(), patches.begin(), patches.end());
    }
}

PatchLocator::Shape PatchLocator::lines_of(const std::array<Vec2, 4>& corners) {
    Shape lines{};
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec2 &a = corners[k], edge = corners[(k + 1) % 4] - a;
        const double length = edge.norm();
        if (length == 0.0) continue;  // of a triangle: nothing is beyond it
        lines[k].u = static_cast<float>(edge.y() / length);
        lines[k].v = static_cast<float>(-edge.x() / length);
        lines[k].w = static_cast<float>((edge.x() * a.y() - edge.y() * a.x()) / length);
    }
    return lines;
}

/// Of the patches listed from first on, before end.
PatchIndex PatchLocator::search(const Cells& cells, std::uint32_t first, std::uint32_t end, float u,
                                float v) const {
    PatchIndex best = cells.first;
    float least_outside = std::numeric_limits<float>::infinity();
    for (std::uint32_t at = first; at < end; ++at) {
        float outside = 0.0f;  // beyond the edge it is farthest beyond
        for (const Line& line : shapes_[lists_[at]])
            outside = std::max(outside, line.u * u + line.v * v + line.w);
        if (outside == 0.0f) return lists_[at];
        if (outside < least_outside) {
            least_outside = outside;
            best = lists_[at];
        }
    }
    return best;
}

}  // namespace patchlight
