#include "solver/mesh/make_patches.h"

#include "solver/mesh/cover_lines.h"
#include "solver/mesh/edge_divisions.h"
#include "solver/mesh/edge_stops.h"
#include "solver/mesh/grid_shape.h"
#include "solver/mesh/polygon_mesher.h"
#include "solver/scene/gap_lines.h"
#include "solver/scene/seen_area.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace patchlight {

namespace {

constexpr double no_area = 1e-12;  // of its surface's: of a patch that is not there for light [1]

struct Mesher {
    const Scene& scene;
    const MeshLines& lines;
    const EdgeDivisions& divisions;
    PatchMesh mesh;

    /// It has no weight in anything, and sees nothing.
    void leave_out(Patch& patch) const {
        patch.area = no_area * scene.surfaces[patch.surface].area;
        patch.covered = true;
    }

    /// Patches of the surface in hand.
    void leave_out_all() {
        for (PatchIndex i = mesh.first_of_surface.back(); i < mesh.size(); ++i)
            leave_out(mesh.patches[i]);
    }

    void add_patch(SurfaceIndex s, const std::array<VertexIndex, 4>& vertices) {
        Patch patch;
        patch.vertices = vertices;
        patch.surface = s;
        std::array<Vec3, 4> corners;
        for (std::size_t k = 0; k < 4; ++k) corners[k] = mesh.vertices[vertices[k]];
        const std::span<const Vec3> ring(corners.data(), patch.corner_count());
        const Vec3& normal = scene.surfaces[s].normal;
        patch.area = vector_area(ring).dot(normal);
        if (!(patch.area > 0.0)) leave_out(patch);  // its corners are on one line, to rounding
        patch.centre = centroid(ring, normal);
        mesh.patches.push_back(patch);
    }

    /// A grid between edges 0-1 and 3-2 (nu parts) and 0-3 and 1-2 (nv parts), bilinear inside.
    void add_grid(SurfaceIndex s) {
        const auto bottom = divisions.points(s, 0), right = divisions.points(s, 1);
        auto top = divisions.points(s, 2), left = divisions.points(s, 3);
        std::reverse(top.begin(), top.end());
        std::reverse(left.begin(), left.end());
        const std::size_t nu = bottom.size() - 1, nv = right.size() - 1;
        mesh.grid.back() = {static_cast<std::uint32_t>(nu), static_cast<std::uint32_t>(nv)};
        std::vector<VertexIndex> grid((nu + 1) * (nv + 1));
        for (std::size_t j = 0; j <= nv; ++j)
            for (std::size_t i = 0; i <= nu; ++i) {
                VertexIndex& vertex = grid[j * (nu + 1) + i];
                if (j == 0)
                    vertex = bottom[i];
                else if (j == nv)
                    vertex = top[i];
                else if (i == 0)
                    vertex = left[j];
                else if (i == nu)
                    vertex = right[j];
                else {
                    const double u = static_cast<double>(i) / static_cast<double>(nu);
                    const Vec3 p = mesh.vertices[left[j]], q = mesh.vertices[right[j]];
                    vertex = static_cast<VertexIndex>(mesh.vertices.size());
                    mesh.vertices.push_back(p + (q - p) * u);
                }
            }
        for (std::size_t j = 0; j < nv; ++j)
            for (std::size_t i = 0; i < nu; ++i) {
                const std::size_t at = j * (nu + 1) + i;
                add_patch(s, {grid[at], grid[at + 1], grid[at + nu + 2], grid[at + nu + 1]});
            }
    }

    void add_polygon_patches(SurfaceIndex s) {
        const Surface& surface = scene.surfaces[s];
        const PlaneFrame frame = frame_along(surface.corners, surface.normal);
        PolygonOutline outline;
        std::vector<VertexIndex> number;  // of the mesher's points in the mesh
        for (std::size_t k = 0; k < surface.corners.size(); ++k) {
            outline.corners.push_back(frame.flat(surface.corners[k]));
            number.push_back(divisions.corner(s, k));
        }
        for (std::size_t k = 0; k < surface.corners.size(); ++k) {
            outline.divisions.emplace_back();
            const std::vector<VertexIndex> points = divisions.points(s, k);
            for (std::size_t i = 1; i + 1 < points.size(); ++i) {
                outline.divisions.back().push_back(frame.flat(mesh.vertices[points[i]]));
                number.push_back(points[i]);
            }
        }
        const std::vector<std::vector<Vec2>> covers = covers_of(s, frame);
        const double longest = lines.hidden[s] ? std::numeric_limits<double>::infinity()
                                               : surface.coarseness * mesh.patch_size;
        const PolygonMesh flat = mesh_polygon(outline, creases_of(s, frame), longest);
        for (std::size_t p = number.size(); p < flat.points.size(); ++p) {
            number.push_back(static_cast<VertexIndex>(mesh.vertices.size()));
            mesh.vertices.push_back(frame.lift(flat.points[p]));
        }
        for (const auto& edge : flat.crease_edges)
            mesh.creases.push_back({std::min(number[edge[0]], number[edge[1]]),
                                    std::max(number[edge[0]], number[edge[1]])});
        for (const auto& face : flat.faces)
            add_patch(s, {number[face[0]], number[face[1]], number[face[2]], number[face[3]]});
        for (PatchIndex i = mesh.first_of_surface.back(); i < mesh.size(); ++i)
            for (const std::vector<Vec2>& cover : covers)
                if (contains(cover, frame.flat(mesh.patches[i].centre))) leave_out(mesh.patches[i]);
    }

    std::vector<std::vector<Vec2>> covers_of(SurfaceIndex s, const PlaneFrame& frame) const {
        std::vector<std::vector<Vec2>> outlines;
        for (const SurfaceIndex cover : lines.overlaps.covered_by[s]) {
            outlines.emplace_back();
            for (const Vec3& p : scene.surfaces[cover].corners)
                outlines.back().push_back(frame.flat(p));
        }
        return outlines;
    }

    std::vector<FlatSegment> creases_of(SurfaceIndex s, const PlaneFrame& frame) const {
        std::vector<FlatSegment> creases;
        for (const Segment& crease : lines.creases[s])
            creases.push_back({frame.flat(crease[0]), frame.flat(crease[1])});
        return creases;
    }
};

/// A triangle whose edges are short enough as they are: the common case in imported meshes.
bool is_one_patch(const Surface& surface, const EdgeDivisions& divisions, SurfaceIndex s) {
    return surface.corners.size() == 3 && divisions.parts(s, 0) == 1 &&
           divisions.parts(s, 1) == 1 && divisions.parts(s, 2) == 1;
}

double distance_to(const Segment& segment, const Vec3& p) {
    const Vec3 along = segment[1] - segment[0];
    const double at = std::clamp((p - segment[0]).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return (p - segment[0] - at * along).norm();
}

double edge_length(const Surface& surface, std::size_t k) {
    return (surface.corners[(k + 1) % surface.corners.size()] - surface.corners[k]).norm();
}

constexpr double any_width = std::numeric_limits<double>::infinity();

double estimate_grid(const Surface& surface, double patch_size, bool cut_slivers) {
    const double u = std::max(edge_length(surface, 0), edge_length(surface, 2));
    const double v = std::max(edge_length(surface, 1), edge_length(surface, 3));
    if (!cut_slivers)
        return estimate_parts(u, patch_size, any_width) * estimate_parts(v, patch_size, any_width);
    const double nu = estimate_parts(u, patch_size, v), nv = estimate_parts(v, patch_size, u);
    return estimate_parts(u, patch_size, v / nv) * estimate_parts(v, patch_size, u / nu);
}

/// Squares inside, and what the outline's parts and corners add to them: coefficients fitted to
/// regular polygons of 3 to 4000 corners, needles, stars and combs.
double estimate_polygon(const Surface& surface, double patch_size, bool cut_slivers) {
    const std::size_t corners = surface.corners.size();
    double parts = 0.0;
    for (std::size_t k = 0; k < corners; ++k)
        parts += estimate_parts(edge_length(surface, k), patch_size,
                                cut_slivers ? width_of(surface) : any_width);
    const double inside = surface.area / (patch_size * patch_size);
    return std::max(1.0, inside + 0.6 * parts + 0.7 * static_cast<double>(corners) - 4.0);
}

}  // namespace

double patch_size_for(const Scene& scene, double patches) {
    double area = 0.0;
    for (const Surface& surface : scene.surfaces)
        if (surface.coarseness == 1.0) area += surface.area;  // what is far changes nothing near
    return std::sqrt(area / patches);
}

std::size_t estimate_patch_count(const Scene& scene, double patch_size, bool cut_slivers) {
    double count = 0.0;
    for (const Surface& surface : scene.surfaces) {
        const double longest = surface.coarseness * patch_size;
        count += fits_a_grid(surface) ? estimate_grid(surface, longest, cut_slivers)
                                      : estimate_polygon(surface, longest, cut_slivers);
    }
    return count < 9e18 ? static_cast<std::size_t>(count) : std::size_t{9'000'000'000'000'000'000u};
}

MeshLines find_mesh_lines(const Scene& scene, const std::function<bool()>& go_on) {
    const LocalTolerance tolerance(scene);
    MeshLines lines{find_coplanar_overlaps(scene, go_on), {}, {}};
    const std::vector<std::vector<Segment>> contacts =
        find_contact_lines(scene, lines.overlaps, go_on);
    const std::vector<double> seen = seen_areas(scene, lines.overlaps, go_on);
    lines.creases.resize(scene.surfaces.size());
    lines.hidden.resize(scene.surfaces.size());
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s) {
        lines.hidden[s] = !(seen[s] > 0.0);
        if (lines.hidden[s]) continue;
        if (go_on && !lines.overlaps.covered_by[s].empty() && !go_on()) break;
        const double reach = tolerance.at(s);
        std::vector<Segment> creases = contacts[s];
        const std::vector<Segment> covers =
            cover_lines(scene, s, lines.overlaps.covered_by[s], reach);
        creases.insert(creases.end(), covers.begin(), covers.end());
        for (const Segment& crease : creases) {
            const Segment snapped = snap_to_outline(scene.surfaces[s], crease, reach);
            if ((snapped[1] - snapped[0]).norm() > reach) lines.creases[s].push_back(snapped);
        }
    }
    return lines;
}

void add_gap_lines(const Scene& scene, MeshLines& lines) {
    const LocalTolerance tolerance(scene);
    const std::vector<std::vector<GapLine>> gaps = find_gap_lines(scene);
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s)
        for (const GapLine& line : gaps[s]) {
            const bool is_there =
                lines.hidden[s] ||
                std::any_of(lines.creases[s].begin(), lines.creases[s].end(),
                            [&](const Segment& crease) {
                                return distance_to(crease, line.at[0]) < 0.5 * line.height &&
                                       distance_to(crease, line.at[1]) < 0.5 * line.height;
                            });
            if (is_there) continue;
            const double reach = tolerance.at(s);
            const Segment snapped = snap_to_outline(scene.surfaces[s], line.at, reach);
            if ((snapped[1] - snapped[0]).norm() > reach) lines.creases[s].push_back(snapped);
        }
}

MeshLines no_lines(const Scene& scene) {
    const std::size_t n = scene.surfaces.size();
    return {{std::vector<std::vector<SurfaceIndex>>(n), std::vector<std::vector<SurfaceIndex>>(n)},
            std::vector<std::vector<Segment>>(n),
            std::vector<bool>(n, false)};
}

PatchMesh make_patches(const Scene& scene, const MeshLines& lines, double patch_size,
                       const std::function<bool(std::size_t)>& go_on) {
    const EdgeDivisions divisions(scene, lines.creases, lines.hidden, patch_size,
                                  lines.cut_slivers);
    Mesher mesher{scene, lines, divisions, {}};
    mesher.mesh.vertices = divisions.vertices();
    mesher.mesh.patch_size = patch_size;
    mesher.mesh.first_of_surface.push_back(0);
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s) {
        constexpr SurfaceIndex at_a_time = 1024;  // without creases
        const bool ask = !lines.creases[s].empty() || s % at_a_time == 0;
        if (ask && go_on && !go_on(mesher.mesh.size())) break;
        mesher.mesh.grid.push_back({0, 0});
        if (divisions.gridded(s))
            mesher.add_grid(s);
        else if (lines.creases[s].empty() && is_one_patch(scene.surfaces[s], divisions, s))
            mesher.add_patch(s, {divisions.corner(s, 0), divisions.corner(s, 1),
                                 divisions.corner(s, 2), divisions.corner(s, 2)});
        else
            mesher.add_polygon_patches(s);
        if (lines.hidden[s]) mesher.leave_out_all();
        mesher.mesh.first_of_surface.push_back(static_cast<PatchIndex>(mesher.mesh.size()));
    }
    std::sort(mesher.mesh.creases.begin(), mesher.mesh.creases.end());
    return std::move(mesher.mesh);
}

PatchMesh uncut_patches(const Scene& scene) {
    constexpr double uncut = 10.0;  // of the scene's size
    return make_patches(scene, no_lines(scene), uncut * scene_size(scene));
}

std::vector<Vec3> patch_corners(const PatchMesh& mesh, PatchIndex i) {
    const Patch& patch = mesh.patches[i];
    std::vector<Vec3> corners;
    for (std::size_t k = 0; k < patch.corner_count(); ++k)
        corners.push_back(mesh.vertices[patch.vertices[k]]);
    return corners;
}

}  // namespace patchlight
