#include "solver/mesh/polygon_mesher.h"

#include "solver/mesh/merge_triangles.h"
#include "solver/mesh/triangulation.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace patchlight {

namespace {

constexpr double clearance = 0.5;  // of a cell, between its vertices and the boundary [1]
constexpr int most_rounds = 24;    // of cutting edges that are still too long

double distance(const FlatSegment& s, const Vec2& p) {
    const Vec2 along = s.b - s.a;
    const double t = std::clamp((p - s.a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return (s.a + t * along - p).norm();
}

/// Unit direction along which most of the boundary runs, quarter turns counted as one.
Vec2 main_direction(const std::vector<Vec2>& corners) {
    Vec2 sum = Vec2::Zero();  // edges as vectors of four times their angle, so quarter turns agree
    double longest = 0.0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Vec2 edge = corners[(k + 1) % corners.size()] - corners[k];
        const double angle = 4.0 * std::atan2(edge.y(), edge.x());
        sum += edge.norm() * Vec2(std::cos(angle), std::sin(angle));
        longest = std::max(longest, edge.norm());
    }
    const double angle = sum.norm() > 1e-6 * longest ? std::atan2(sum.y(), sum.x()) / 4.0 : 0.0;
    return {std::cos(angle), std::sin(angle)};
}

/// Corner of the lattice: the start of the longest edge that runs along it.
Vec2 lattice_origin(const std::vector<Vec2>& corners, const Vec2& direction) {
    Vec2 origin = corners[0];
    double longest = 0.0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Vec2 edge = corners[(k + 1) % corners.size()] - corners[k];
        const double length = edge.norm();
        const double slope = std::abs(edge.x() * direction.y() - edge.y() * direction.x());
        if (slope > 1e-6 * length || length <= (1.0 + 1e-9) * longest) continue;
        longest = length;
        origin = corners[k];
    }
    return origin;
}

void insert_lattice(Triangulation& triangulation, const std::vector<Vec2>& corners,
                    const std::vector<FlatSegment>& walls, double longest) {
    const Vec2 along = main_direction(corners);
    const Vec2 across(-along.y(), along.x());
    const Vec2 origin = lattice_origin(corners, along);
    Eigen::AlignedBox2d box;
    for (const Vec2& p : corners)
        box.extend(Vec2((p - origin).dot(along), (p - origin).dot(across)));
    Vec2 cell;
    for (int axis = 0; axis < 2; ++axis)
        cell[axis] =
            box.sizes()[axis] / std::max(1.0, std::ceil(box.sizes()[axis] / longest - 1e-9));
    const auto i0 = std::llround(std::floor(box.min().x() / cell.x())),
               i1 = std::llround(std::ceil(box.max().x() / cell.x()));
    const auto j0 = std::llround(std::floor(box.min().y() / cell.y())),
               j1 = std::llround(std::ceil(box.max().y() / cell.y()));
    const double least = clearance * (1.0 - 1e-9) * cell.minCoeff();
    for (auto j = j0; j <= j1; ++j)
        for (auto i = i0; i <= i1; ++i) {
            const Vec2 p = origin + static_cast<double>(i) * cell.x() * along +
                           static_cast<double>(j) * cell.y() * across;
            if (!contains(corners, p)) continue;
            if (std::any_of(walls.begin(), walls.end(),
                            [&](const FlatSegment& s) { return distance(s, p) < least; }))
                continue;
            triangulation.insert(p);
        }
}

/// Where the segment meets the walls, as places along it in [0, 1], both ends among them.
std::vector<double> breaks(const FlatSegment& s, const std::vector<FlatSegment>& walls,
                           double longest) {
    const Vec2 along = s.b - s.a;
    std::vector<double> places{0.0, 1.0};
    for (const FlatSegment& wall : walls) {
        const double at_a = turn(wall.a, wall.b, s.a), at_b = turn(wall.a, wall.b, s.b);
        if ((at_a > 0.0) != (at_b > 0.0)) places.push_back(at_a / (at_a - at_b));
        for (const Vec2& p : {wall.a, wall.b}) {  // ends that lie on the segment
            const double t = (p - s.a).dot(along) / along.squaredNorm();
            if (t > 0.0 && t < 1.0 && (s.a + t * along - p).norm() < 1e-9 * along.norm())
                places.push_back(t);
        }
    }
    std::sort(places.begin(), places.end());
    std::vector<double> fine{0.0};
    for (std::size_t k = 1; k < places.size(); ++k) {
        const double gap = places[k] - places[k - 1];
        const int parts =
            std::max(1, static_cast<int>(std::ceil(gap * along.norm() / longest - 1e-9)));
        for (int i = 1; i <= parts; ++i) fine.push_back(places[k - 1] + gap * i / parts);
    }
    return fine;
}

/// Makes the creases edges of the triangulation; returns what of them lies inside.
std::vector<FlatSegment> insert_creases(Triangulation& triangulation,
                                        std::span<const FlatSegment> creases,
                                        const std::vector<FlatSegment>& boundary, double longest) {
    std::vector<FlatSegment> walls = boundary, inside;
    walls.insert(walls.end(), creases.begin(), creases.end());
    for (std::size_t w = boundary.size(); w < walls.size(); ++w) {
        const FlatSegment s = walls[w];
        std::optional<int> before;
        for (const double t : breaks(s, walls, longest)) {
            const std::optional<int> here = triangulation.insert(s.a + t * (s.b - s.a));
            if (before && here && *before != *here) {
                triangulation.fix_edge(*before, *here);
                inside.push_back({triangulation.points()[*before], triangulation.points()[*here]});
            }
            before = here;
        }
    }
    return inside;
}

/// Points half-way along the longest edge of each face that is too long. Edges on the boundary and
/// on creases are short from the start.
std::vector<Vec2> points_wanted(const Triangulation& triangulation, const MergedFaces& merged,
                                double longest) {
    std::vector<Vec2> wanted;
    const auto& points = triangulation.points();
    for (const auto& face : merged.faces) {
        double worst = longest * (1.0 + 1e-9);
        std::optional<Vec2> middle;
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec2 &a = points[face[k]], &b = points[face[(k + 1) % 4]];
            if ((b - a).norm() <= worst) continue;
            worst = (b - a).norm() * (1.0 + 1e-9);
            middle = 0.5 * (a + b);
        }
        if (middle) wanted.push_back(*middle);
    }
    return wanted;
}

std::vector<std::array<std::uint32_t, 2>> crease_edges(const Triangulation& triangulation) {
    std::vector<std::array<std::uint32_t, 2>> edges;
    for (const Triangulation::Triangle& triangle : triangulation.triangles())
        for (int k = 0; k < 3; ++k) {
            if (!triangle.fixed[k] || triangle.across[k] == Triangulation::none) continue;
            const int a = triangle.vertices[(k + 1) % 3], b = triangle.vertices[(k + 2) % 3];
            if (a < b)
                edges.push_back({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)});
        }
    return edges;
}

/// By its ends and not by its place: near the tip of a needle all edges are near.
void cut_edge(Triangulation& triangulation, std::size_t edge, const PolygonOutline& outline) {
    int from = static_cast<int>(edge);
    const int to = static_cast<int>((edge + 1) % outline.corners.size());
    for (const Vec2& p : outline.divisions[edge]) {
        const std::optional<int> cut = triangulation.split_boundary(from, to, p);
        assert(cut);
        from = cut.value_or(from);
    }
}

}  // namespace

PolygonMesh mesh_polygon(const PolygonOutline& outline, std::span<const FlatSegment> creases,
                         double longest) {
    Triangulation triangulation(outline.corners);
    assert(triangulation.ok());
    std::vector<FlatSegment> walls;
    for (std::size_t k = 0; k < outline.corners.size(); ++k) {
        cut_edge(triangulation, k, outline);
        walls.push_back({outline.corners[k], outline.corners[(k + 1) % outline.corners.size()]});
    }
    const std::vector<FlatSegment> inner = insert_creases(triangulation, creases, walls, longest);
    walls.insert(walls.end(), inner.begin(), inner.end());
    insert_lattice(triangulation, outline.corners, walls, longest);
    MergedFaces merged = merge_triangles(triangulation);
    for (int round = 0; round < most_rounds; ++round) {
        const std::vector<Vec2> wanted = points_wanted(triangulation, merged, longest);
        if (wanted.empty()) break;
        for (const Vec2& p : wanted) triangulation.insert(p);
        merged = merge_triangles(triangulation);
    }
    return {triangulation.points(), std::move(merged.faces), crease_edges(triangulation)};
}

}  // namespace patchlight
