#include "tests/solver/mesh/mesh_checks.h"

#include "solver/scene/polygon.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>

namespace patchlight {

namespace {

constexpr double on_line = 1e-9;   // of the segment's length [1]
constexpr double clear_of = 1e-9;  // of the surface's size: points this near an edge do not count
constexpr double shrink = 1e-6;    // of a patch, so that a line along its edge does not cut it

std::vector<PatchIndex> patches_of(const CutScene& cut, SurfaceIndex s) {
    std::vector<PatchIndex> patches;
    for (PatchIndex i = cut.mesh.first_of_surface[s]; i < cut.mesh.first_of_surface[s + 1]; ++i)
        patches.push_back(i);
    return patches;
}

template <typename Visit>
void for_each_edge(const CutScene& cut, PatchIndex i, const Visit& visit) {
    const Patch& patch = cut.mesh.patches[i];
    for (std::size_t k = 0; k < patch.corner_count(); ++k)
        visit(patch.vertices[k], patch.vertices[(k + 1) % patch.corner_count()]);
}

double edge_length(const CutScene& cut, VertexIndex a, VertexIndex b) {
    return (cut.mesh.vertices[a] - cut.mesh.vertices[b]).norm();
}

double size_of(const Surface& surface) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : surface.corners) box.extend(p);
    return box.diagonal().norm();
}

std::map<std::pair<VertexIndex, VertexIndex>, int> directed_edges(const CutScene& cut,
                                                                  SurfaceIndex s) {
    std::map<std::pair<VertexIndex, VertexIndex>, int> edges;
    for (const PatchIndex i : patches_of(cut, s))
        for_each_edge(cut, i, [&](VertexIndex a, VertexIndex b) { ++edges[{a, b}]; });
    return edges;
}

}  // namespace

double area_error(const CutScene& cut) {
    double worst = 0.0;
    for (SurfaceIndex s = 0; s < cut.scene.surfaces.size(); ++s) {
        double sum = 0.0;
        for (const PatchIndex i : patches_of(cut, s))
            if (!cut.mesh.patches[i].covered) sum += cut.mesh.patches[i].area;
        if (covered_area(cut, s) > 0.0) continue;  // what is covered has no patches
        worst = std::max(worst, std::abs(sum / cut.scene.surfaces[s].area - 1.0));
    }
    return worst;
}

double longest_edge(const CutScene& cut) {
    double longest = 0.0;
    for (PatchIndex i = 0; i < cut.mesh.size(); ++i)
        for_each_edge(cut, i, [&](VertexIndex a, VertexIndex b) {
            longest = std::max(longest, edge_length(cut, a, b));
        });
    return longest / cut.mesh.patch_size;
}

double least_sine(const CutScene& cut) {
    double least = 1.0;
    for (PatchIndex i = 0; i < cut.mesh.size(); ++i) {
        const std::vector<Vec3> p = patch_corners(cut.mesh, i);
        const Vec3& normal = cut.scene.surfaces[cut.mesh.patches[i].surface].normal;
        for (std::size_t k = 0; k < p.size(); ++k) {
            const Vec3 in = p[(k + 1) % p.size()] - p[k],
                       out = p[(k + 2) % p.size()] - p[(k + 1) % p.size()];
            least = std::min(least, in.cross(out).dot(normal) / (in.norm() * out.norm()));
        }
    }
    return least;
}

double worst_aspect(const CutScene& cut) {
    double worst = 0.0;
    for (PatchIndex i = 0; i < cut.mesh.size(); ++i)
        for_each_edge(cut, i, [&](VertexIndex a, VertexIndex b) {
            const double length = edge_length(cut, a, b);
            worst = std::max(worst, length * length / cut.mesh.patches[i].area);
        });
    return worst;
}

double worst_height(const CutScene& cut) {
    double worst = 0.0;
    for (PatchIndex i = 0; i < cut.mesh.size(); ++i) {
        const Surface& surface = cut.scene.surfaces[cut.mesh.patches[i].surface];
        for (const Vec3& p : patch_corners(cut.mesh, i))
            worst = std::max(
                worst, std::abs((p - surface.corners[0]).dot(surface.normal)) / size_of(surface));
    }
    return worst;
}

double excess_outline(const CutScene& cut, SurfaceIndex s) {
    const auto edges = directed_edges(cut, s);
    double alone = 0.0, outline = 0.0;
    for (const auto& [edge, count] : edges)
        if (!edges.contains({edge.second, edge.first}))
            alone += edge_length(cut, edge.first, edge.second);
    const std::vector<Vec3>& corners = cut.scene.surfaces[s].corners;
    for (std::size_t k = 0; k < corners.size(); ++k)
        outline += (corners[(k + 1) % corners.size()] - corners[k]).norm();
    return alone / outline - 1.0;
}

std::size_t edges_shared_wrongly(const CutScene& cut, SurfaceIndex s) {
    const auto edges = directed_edges(cut, s);
    return static_cast<std::size_t>(std::count_if(
        edges.begin(), edges.end(), [](const auto& entry) { return entry.second > 1; }));
}

std::set<VertexIndex> vertices_along(const CutScene& cut, SurfaceIndex s, const Vec3& a,
                                     const Vec3& b) {
    std::set<VertexIndex> found;
    const double length = (b - a).norm();
    for (const PatchIndex i : patches_of(cut, s))
        for (const VertexIndex v : cut.mesh.patches[i].vertices) {
            const Vec3& p = cut.mesh.vertices[v];
            const double t = (p - a).dot(b - a) / (length * length);
            if (t > -on_line && t < 1.0 + on_line &&
                (a + t * (b - a) - p).norm() < on_line * length)
                found.insert(v);
        }
    return found;
}

std::string edges_not_shared(const CutScene& cut) {
    std::string wrong;
    const auto& surfaces = cut.scene.surfaces;
    for (SurfaceIndex s = 0; s < surfaces.size(); ++s)
        for (SurfaceIndex t = s + 1; t < surfaces.size(); ++t)
            for (std::size_t k = 0; k < surfaces[s].corners.size(); ++k)
                for (std::size_t l = 0; l < surfaces[t].corners.size(); ++l) {
                    const auto &p = surfaces[s].corners, &q = surfaces[t].corners;
                    const Vec3 &a = p[k], &b = p[(k + 1) % p.size()];
                    const Vec3 &c = q[l], &d = q[(l + 1) % q.size()];
                    const double reach = on_line * (b - a).norm();
                    const bool same = (a - c).norm() < reach && (b - d).norm() < reach;
                    const bool opposite = (a - d).norm() < reach && (b - c).norm() < reach;
                    if (!same && !opposite) continue;
                    if (vertices_along(cut, s, a, b) != vertices_along(cut, t, a, b))
                        wrong += "surfaces " + std::to_string(s) + " and " + std::to_string(t) +
                                 " at edge " + std::to_string(k) + "; ";
                }
    return wrong;
}

int points_not_in_one_patch(const CutScene& cut, SurfaceIndex s, int count, unsigned seed) {
    const Surface& surface = cut.scene.surfaces[s];
    const PlaneFrame frame = frame_of(surface.corners[0], surface.normal);
    std::vector<Vec2> outline;
    Eigen::AlignedBox2d box;
    for (const Vec3& p : surface.corners) box.extend(outline.emplace_back(frame.flat(p)));
    const double margin = clear_of * box.diagonal().norm();
    std::mt19937 chance(seed);
    int wrong = 0;
    for (int n = 0; n < count; ++n) {
        const Vec2 q = box.min() + Vec2(uniform(chance), uniform(chance)).cwiseProduct(box.sizes());
        if (!contains(outline, q)) continue;
        int holders = 0;
        bool on_edge = false;
        for (const PatchIndex i : patches_of(cut, s)) {
            const std::vector<Vec3> p = patch_corners(cut.mesh, i);
            double depth = 1e300;  // inside the edge it is least inside of
            for (std::size_t k = 0; k < p.size(); ++k) {
                const Vec2 a = frame.flat(p[k]), b = frame.flat(p[(k + 1) % p.size()]);
                depth = std::min(depth, turn(a, b, q) / (b - a).norm());
            }
            holders += depth > 0.0;
            on_edge |= std::abs(depth) < margin;
        }
        wrong += holders != 1 && !on_edge;
    }
    return wrong;
}

double covered_area(const CutScene& cut, SurfaceIndex s) {
    double seen = 0.0;
    bool is_covered = false;
    for (const PatchIndex i : patches_of(cut, s)) {
        is_covered = is_covered || cut.mesh.patches[i].covered;
        if (!cut.mesh.patches[i].covered) seen += cut.mesh.patches[i].area;
    }
    return is_covered ? cut.scene.surfaces[s].area - seen : 0.0;
}

int patches_cut_by_contacts(const CutScene& cut, SurfaceIndex s) {
    const Surface& surface = cut.scene.surfaces[s];
    const PlaneFrame frame = frame_of(surface.corners[0], surface.normal);
    int count = 0;
    for (const PatchIndex i : patches_of(cut, s)) {
        std::vector<Vec2> p;
        const Vec2 centre = frame.flat(cut.mesh.patches[i].centre);
        for (const Vec3& corner : patch_corners(cut.mesh, i))
            p.push_back(centre + (1.0 - shrink) * (frame.flat(corner) - centre));
        count += std::any_of(
            cut.lines.creases[s].begin(), cut.lines.creases[s].end(), [&](const Segment& line) {
                const Vec2 a = frame.flat(line[0]), b = frame.flat(line[1]);
                double from = 0.0, to = 1.0;  // the part of the line inside the patch
                for (std::size_t k = 0; k < p.size(); ++k) {
                    const double at_a = turn(p[k], p[(k + 1) % p.size()], a),
                                 at_b = turn(p[k], p[(k + 1) % p.size()], b);
                    if (at_a < 0.0 && at_b < 0.0) return false;
                    if (at_a < 0.0) from = std::max(from, at_a / (at_a - at_b));
                    if (at_b < 0.0) to = std::min(to, at_a / (at_a - at_b));
                }
                return from < to;
            });
    }
    return count;
}

}  // namespace patchlight
