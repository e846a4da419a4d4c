#include "solver/scene/far_reaching.h"

#include "solver/scene/coplanar.h"
#include "solver/scene/local_frames.h"
#include "solver/scene/polygon.h"

#include <array>
#include <cmath>
#include <utility>

namespace patchlight {

namespace {

constexpr double far_reaching = 16.0;  // of a frame's radius, the size of a polygon to be cut [1]
constexpr double nearby = 2.0;  // of a frame's radius: half the side of the innermost square [1]
constexpr double growth = 4.0;  // of each square over the one within [1]
// Patches' edges over those of what is near: a ring then has as many as a quarter of a floor [1].
constexpr double coarser_near = 3.0, coarser_far = 4.0;
constexpr double fewest = 1.0 / 16.0;  // of the patches of the main frame, that another has [1]
constexpr double no_area = 1e-9;       // of the square of a piece's size: nothing is left of it [1]

using Outline = std::vector<Vec2>;

/// The part of a convex polygon in another, both counter-clockwise.
Outline within(Outline part, std::span<const Vec2> other) {
    for (std::size_t k = 0; k < other.size() && part.size() >= 3; ++k)
        part = clip_left(part, other[k], other[(k + 1) % other.size()]);
    return part;
}

bool is_convex(std::span<const Vec2> p) {
    for (std::size_t k = 0; k < p.size(); ++k)
        if (turn(p[k], p[(k + 1) % p.size()], p[(k + 2) % p.size()]) < 0.0) return false;
    return true;
}

/// The polygon in convex parts: itself, or triangles.
std::vector<Outline> convex_parts(const Outline& polygon) {
    if (is_convex(polygon)) return {polygon};
    std::vector<Outline> parts;
    for (const auto& t : triangulate(polygon))
        parts.push_back({polygon[t[0]], polygon[t[1]], polygon[t[2]]});
    return parts;
}

std::array<Vec2, 4> square(double half) {
    return {Vec2(-half, -half), Vec2(half, -half), Vec2(half, half), Vec2(-half, half)};
}

struct Piece {
    Outline outline;
    double coarseness = 1.0;
};

void add_piece(const std::vector<Outline>& parts, std::span<const Vec2> cell, double coarseness,
               std::vector<Piece>& pieces) {
    for (const Outline& part : parts) {
        Outline piece = within(part, cell);
        if (piece.size() < 3) continue;
        Eigen::AlignedBox2d box;
        for (const Vec2& p : piece) box.extend(p);
        if (signed_area(piece) > no_area * box.diagonal().squaredNorm())
            pieces.push_back({std::move(piece), coarseness});
    }
}

/// About the origin.
std::vector<Piece> cut_in_rings(const Outline& polygon, double half) {
    double farthest = 0.0;
    for (const Vec2& p : polygon) farthest = std::max(farthest, p.cwiseAbs().maxCoeff());
    const std::vector<Outline> parts = convex_parts(polygon);
    std::vector<Piece> pieces;
    add_piece(parts, square(half), coarser_near, pieces);
    for (double inner = half; inner < farthest; inner *= growth) {
        const auto in = square(inner), out = square(growth * inner);
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t l = (k + 1) % 4;
            add_piece(parts, std::array{out[k], out[l], in[l], in[k]},
                      coarser_far * growth * inner / half, pieces);
        }
    }
    return pieces;
}

/// A frame of the plane that is the same for both halves of a two-sided polygon.
PlaneFrame plane_about(const Vec3& origin, const Vec3& normal) {
    const bool flip = normal.x() < 0.0 || (normal.x() == 0.0 && normal.y() < 0.0) ||
                      (normal.x() == 0.0 && normal.y() == 0.0 && normal.z() < 0.0);
    return frame_of(origin, flip ? Vec3(-normal) : normal);
}

std::vector<Surface> pieces_of(const Surface& surface, const LocalFrame& frame) {
    const double height = (frame.origin() - surface.corners[0]).dot(surface.normal);
    const PlaneFrame plane = plane_about(frame.origin() - height * surface.normal, surface.normal);
    const bool flipped = plane.normal.dot(surface.normal) < 0.0;
    Outline outline;
    for (const Vec3& p : surface.corners) outline.push_back(plane.flat(p));
    if (flipped) std::reverse(outline.begin(), outline.end());
    std::vector<Surface> pieces;
    for (auto& [flat, coarseness] : cut_in_rings(outline, nearby * frame.radius())) {
        if (flipped) std::reverse(flat.begin(), flat.end());
        Surface piece = surface;
        piece.cut_from_larger = true;
        piece.coarseness = coarseness;
        piece.area = std::abs(signed_area(flat));
        piece.corners.clear();
        for (const Vec2& q : flat) {
            Vec3 p = plane.lift(q);
            for (const Vec3& corner : surface.corners)  // as given, not as it was rounded
                if (plane.flat(corner) == q) p = corner;
            piece.corners.push_back(p);
        }
        pieces.push_back(std::move(piece));
    }
    return pieces;
}

bool reaches_beyond(const Box3& box, const Surface& surface, const LocalFrame& frame) {
    const double radius = frame.radius();
    if (!(radius > 0.0) || box.diagonal().norm() <= far_reaching * radius) return false;
    const Box3 near(frame.box.min().array() - radius, frame.box.max().array() + radius);
    return near.intersects(box) &&
           std::abs((frame.origin() - surface.corners[0]).dot(surface.normal)) < 4.0 * radius;
}

void cut_far_reaching(Scene& scene, const std::vector<LocalFrame>& frames) {
    for (const LocalFrame& frame : frames) {
        std::vector<Surface> surfaces;
        for (Surface& surface : scene.surfaces) {
            Box3 box;
            for (const Vec3& p : surface.corners) box.extend(p);
            if (!reaches_beyond(box, surface, frame)) {
                surfaces.push_back(std::move(surface));
                continue;
            }
            for (Surface& piece : pieces_of(surface, frame)) surfaces.push_back(std::move(piece));
        }
        scene.surfaces = std::move(surfaces);
    }
}

/// The frame that gives off most light, or has most surfaces, has patches as if it were alone;
/// another has as many, or less if it has fewer surfaces, and few along one that is long and thin.
void make_far_ones_coarser(Scene& scene, const LocalFrames& found) {
    struct Share {
        double power = 0.0, area = 0.0, count = 0.0;
    };
    std::vector<Share> shares(found.frames.size());
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s) {
        if (scene.surfaces[s].cut_from_larger) continue;
        const Surface& surface = scene.surfaces[s];
        Share& share = shares[found.of_surface[s]];
        share.power += surface.area * luminance(scene.materials[surface.material].exitance);
        share.area += surface.area;
        share.count += 1.0;
    }
    const auto main =
        std::max_element(shares.begin(), shares.end(), [](const Share& a, const Share& b) {
            return std::pair(a.power, a.count) < std::pair(b.power, b.count);
        });
    const std::vector<Box3> boxes = surface_boxes(scene);
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s) {
        const Share& own = shares[found.of_surface[s]];
        if (scene.surfaces[s].cut_from_larger || &own == &*main) continue;
        const double patches = std::clamp(own.count / main->count, fewest, 1.0);
        scene.surfaces[s].coarseness = std::max(std::sqrt(own.area / main->area / patches),
                                                boxes[s].diagonal().norm() / std::sqrt(main->area));
    }
}

}  // namespace

void settle_far_geometry(Scene& scene) {
    const LocalFrames found = find_local_frames(scene, surface_boxes(scene));
    if (found.frames.size() == 1) return;
    cut_far_reaching(scene, found.frames);
    make_far_ones_coarser(scene, find_local_frames(scene, surface_boxes(scene)));
}

}  // namespace patchlight
