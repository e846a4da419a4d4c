#include "solver/scene/seen_area.h"

#include "solver/scene/polygon.h"

#include <array>
#include <utility>

namespace patchlight {

namespace {

constexpr double nothing = 1e-9;  // of the surface: what rounding leaves at the rim of a cover [1]

using Outline = std::vector<Vec2>;

std::vector<Outline> flat_triangles_of(const Surface& surface, const PlaneFrame& frame) {
    Outline flat;
    for (const Vec3& p : surface.corners) flat.push_back(frame.flat(p));
    std::vector<Outline> triangles;
    for (const auto& t : triangulate(flat))
        triangles.push_back({flat[t[0]], flat[t[1]], flat[t[2]]});
    return triangles;
}

/// What a triangle leaves of convex pieces: convex pieces. Smaller ones than `least` are let go.
std::vector<Outline> without(const std::vector<Outline>& pieces, const Outline& triangle,
                             double least) {
    std::vector<Outline> left;
    for (Outline piece : pieces) {
        bool apart = false;  // the whole piece is beyond one of the triangle's sides
        for (std::size_t k = 0; k < 3 && !apart; ++k) {
            const Vec2 &a = triangle[k], &b = triangle[(k + 1) % 3];
            apart = std::all_of(piece.begin(), piece.end(),
                                [&](const Vec2& p) { return turn(a, b, p) <= 0.0; });
        }
        if (apart) {
            left.push_back(std::move(piece));
            continue;
        }
        for (std::size_t k = 0; k < 3 && piece.size() >= 3; ++k) {
            const Vec2 &a = triangle[k], &b = triangle[(k + 1) % 3];
            Outline beyond = clip_left(piece, b, a);
            if (beyond.size() >= 3 && signed_area(beyond) > least)
                left.push_back(std::move(beyond));
            piece = clip_left(piece, a, b);
        }
    }
    return left;
}

double seen_area(const Scene& scene, const Surface& surface,
                 const std::vector<SurfaceIndex>& covers) {
    const PlaneFrame frame = frame_of(surface.corners[0], surface.normal);
    std::vector<Outline> pieces = flat_triangles_of(surface, frame);
    for (const SurfaceIndex cover : covers) {
        for (const Outline& triangle : flat_triangles_of(scene.surfaces[cover], frame))
            pieces = without(pieces, triangle, nothing * nothing * surface.area);
        if (pieces.empty()) return 0.0;
    }
    double area = 0.0;
    for (const Outline& piece : pieces) area += signed_area(piece);
    return area > nothing * surface.area ? area : 0.0;
}

}  // namespace

std::vector<double> seen_areas(const Scene& scene, const CoplanarOverlaps& overlaps,
                               const std::function<bool()>& go_on) {
    std::vector<double> areas;
    bool going = true;
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s) {
        const std::vector<SurfaceIndex>& covers = overlaps.covered_by[s];
        going = going && (covers.empty() || !go_on || go_on());
        areas.push_back(covers.empty() || !going ? scene.surfaces[s].area
                                                 : seen_area(scene, scene.surfaces[s], covers));
    }
    return areas;
}

}  // namespace patchlight
