#include "solver/scene/scene.h"

#include "solver/scene/finding_words.h"
#include "solver/scene/input_error.h"
#include "solver/scene/keyholes.h"
#include "solver/scene/polygon.h"
#include "solver/scene/polygon_with_holes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace patchlight {

namespace {

constexpr double planarity = 1e-6;  // of the polygon's size: beyond, it is cut [1]
// Of the polygon's size squared: narrower ones are less than rounding leaves of a ray's aim [1].
constexpr double least_area = 1e-9;
constexpr double same_point = 1e-12;        // of the polygon's size [1]
constexpr double same_place = 1e-9;         // the same of rings that must not touch [1]
constexpr std::size_t most_corners = 4096;  // of one polygon

constexpr const char* crossing =
    "the polygon touches or crosses itself; its corners must run once round its edge, and holes "
    "stand in `holes` beside it";

double box_diagonal(std::span<const Vec3> points) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : points) box.extend(p);
    return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

std::vector<Vec3> without_repeats(std::span<const Vec3> corners, double size) {
    std::vector<Vec3> kept;
    for (const Vec3& p : corners)
        if (kept.empty() || (p - kept.back()).norm() > same_point * size) kept.push_back(p);
    while (kept.size() > 1 && (kept.front() - kept.back()).norm() <= same_point * size)
        kept.pop_back();
    return kept;
}

/// Whether corners whose vector area is nothing are off one line nevertheless: loops that run
/// opposite ways round cancel, as in a bow tie.
bool spreads_out(std::span<const Vec3> corners, double size) {
    if (corners.size() < 3) return false;
    Vec3 along = Vec3::Zero();
    for (const Vec3& p : corners)
        if ((p - corners[0]).norm() > along.norm()) along = p - corners[0];
    return std::any_of(corners.begin(), corners.end(), [&](const Vec3& p) {
        return (p - corners[0]).cross(along).norm() > 4.0 * least_area * size * size;
    });
}

/// The prototype with these corners, and its reverse if the material is two-sided.
void add_surface(Scene& scene, Surface surface, std::vector<Vec3> corners) {
    const Vec3 area = vector_area(corners);
    surface.area = area.norm();
    surface.normal = area / surface.area;
    surface.corners = std::move(corners);
    scene.surfaces.push_back(surface);
    if (!scene.materials[surface.material].two_sided) return;
    std::reverse(surface.corners.begin(), surface.corners.end());
    surface.normal = -surface.normal;
    surface.side = Side::back;
    scene.surfaces.push_back(std::move(surface));
}

bool is_planar(std::span<const Vec3> corners, const Vec3& normal, double size) {
    Vec3 mean = Vec3::Zero();
    for (const Vec3& p : corners) mean += p / static_cast<double>(corners.size());
    return std::all_of(corners.begin(), corners.end(), [&](const Vec3& p) {
        return std::abs((p - mean).dot(normal)) <= planarity * size;
    });
}

std::vector<std::array<std::uint32_t, 3>> cut_ears(std::span<const Vec2> flat) {
    if (flat.size() == 4 && turn(flat[0], flat[1], flat[2]) > 0 &&
        turn(flat[0], flat[2], flat[3]) > 0)
        return {{0, 1, 2}, {0, 2, 3}};
    return triangulate(flat);
}

/// Adds what the outline, the first ring, holds and the holes leave, in convex pieces of one face.
void add_rings(Scene& scene, const Surface& surface, const Rings<Vec3>& rings, double size,
               const std::string& pointer) {
    const Vec3 normal = vector_area(rings.front()).normalized();
    const PlaneFrame frame = frame_of(rings.front().front(), normal);
    std::vector<Vec3> corners;
    Rings<Vec2> flat;
    for (const std::vector<Vec3>& ring : rings) {
        corners.insert(corners.end(), ring.begin(), ring.end());
        flat.emplace_back();
        for (const Vec3& p : ring) flat.back().push_back(frame.flat(p));
    }
    if (const std::string fault = fault_of(flat, same_place * size); !fault.empty())
        throw InputError(pointer, fault);
    const bool planar = is_planar(corners, normal, size);
    const auto pieces = cut_round_holes(flat, !planar);
    if (pieces.empty()) throw InputError(pointer, "holes leave parts too narrow to be told apart");
    if (!planar)
        note(scene, surface.object,
             {"non-planar",
              {},
              "a polygon off its plane by more than 1e-6 of its size was cut into triangles near " +
                  place_text(corners.front(), size),
              "give triangles, or corners that lie in one plane"});
    for (const auto& piece : pieces) {
        std::vector<Vec3> part;
        for (const std::uint32_t k : piece) part.push_back(corners[k]);
        add_surface(scene, surface, std::move(part));
    }
}

/// A polygon whose corners run round its holes as well. Returns false if it is none.
bool add_keyhole(Scene& scene, const Surface& surface, std::span<const Vec3> corners, double size,
                 const std::string& pointer) {
    const Rings<Vec3> rings = without_bridges(corners, same_place * size);
    if (rings.size() < 2) return false;
    const Vec3 outwards = vector_area(rings.front());
    const bool is_outline_and_holes = std::all_of(
        rings.begin() + 1, rings.end(),
        [&](const std::vector<Vec3>& ring) { return vector_area(ring).dot(outwards) < 0.0; });
    if (!is_outline_and_holes) return false;
    add_rings(scene, surface, rings, size, pointer);
    return true;
}

void require_few_corners(std::size_t count, const std::string& pointer) {
    if (count > most_corners)
        throw InputError(pointer, "has " + std::to_string(count) + " corners; at most " +
                                      std::to_string(most_corners) + " are allowed");
}

}  // namespace

void note(Scene& scene, ObjectIndex object, const Finding& finding) {
    Object& noted = scene.objects[object];
    for (const std::size_t number : noted.findings)
        if (scene.findings[number].kind == finding.kind) {
            ++scene.findings[number].count;
            return;
        }
    noted.findings.push_back(scene.findings.size());
    scene.findings.push_back(finding);
    scene.findings.back().objects = {noted.name};
}

void add_polygon(Scene& scene, ObjectIndex object, MaterialIndex material, std::uint32_t face,
                 std::span<const Vec3> given, const std::string& pointer) {
    require_few_corners(given.size(), pointer);
    const double size = box_diagonal(given);
    std::vector<Vec3> corners = without_repeats(given, size);
    const Vec3 area = corners.size() < 3 ? Vec3(Vec3::Zero()) : vector_area(corners);
    if (!(area.norm() > least_area * size * size)) {
        if (spreads_out(corners, size)) throw InputError(pointer, crossing);
        note(scene, object,
             {"degenerate-dropped",
              {},
              "a polygon without area was left out near " +
                  place_text(corners.empty() ? Vec3(Vec3::Zero()) : corners[0], size),
              "remove it, or give it corners that span an area"});
        return;
    }
    Surface surface;
    surface.material = material;
    surface.object = object;
    surface.face = face;
    const Vec3 normal = area.normalized();
    const PlaneFrame frame = frame_of(corners[0], normal);
    std::vector<Vec2> flat;
    for (const Vec3& p : corners) flat.push_back(frame.flat(p));
    const auto triangles = cut_ears(flat);
    if (triangles.size() + 2 != corners.size() || crosses_itself(flat)) {
        if (add_keyhole(scene, surface, corners, size, pointer)) return;
        throw InputError(pointer, crossing);
    }
    if (is_planar(corners, normal, size)) {
        add_surface(scene, surface, std::move(corners));
        return;
    }
    note(scene, object,
         {"non-planar",
          {},
          "a polygon off its plane by more than 1e-6 of its size was cut into triangles near " +
              place_text(centroid(corners, normal), size),
          "give triangles, or corners that lie in one plane"});
    for (const auto& t : triangles)
        add_surface(scene, surface, {corners[t[0]], corners[t[1]], corners[t[2]]});
}

void add_polygon_with_holes(Scene& scene, ObjectIndex object, MaterialIndex material,
                            std::uint32_t face, std::span<const Vec3> given,
                            std::span<const std::vector<Vec3>> holes, const std::string& pointer) {
    const double size = box_diagonal(given);
    std::size_t count = given.size();
    for (const std::vector<Vec3>& hole : holes) count += hole.size();
    require_few_corners(count, pointer);
    Rings<Vec3> rings{without_repeats(given, size)};
    const auto has_area = [&](const std::vector<Vec3>& ring) {
        return ring.size() >= 3 && vector_area(ring).norm() > least_area * size * size;
    };
    if (!has_area(rings.front()))
        throw InputError(pointer, "the polygon round the holes has no area");
    const Vec3 outwards = vector_area(rings.front());
    for (const std::vector<Vec3>& hole : holes) {
        rings.push_back(without_repeats(hole, size));
        std::vector<Vec3>& ring = rings.back();
        if (!has_area(ring)) throw InputError(pointer, "a hole has no area");
        if (vector_area(ring).dot(outwards) > 0.0) std::reverse(ring.begin(), ring.end());
        constexpr double off_plane = 1e-3;  // of the polygon's size: no rounding of a drawing [1]
        for (const Vec3& p : ring)
            if (std::abs((p - rings.front().front()).dot(outwards.normalized())) > off_plane * size)
                throw InputError(pointer, "a hole does not lie in the plane of its polygon");
    }
    Surface surface;
    surface.material = material;
    surface.object = object;
    surface.face = face;
    add_rings(scene, surface, rings, size, pointer);
}

double scene_size(const Scene& scene) {
    Eigen::AlignedBox3d box;
    for (const Surface& surface : scene.surfaces)
        for (const Vec3& p : surface.corners) box.extend(p);
    return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

bool is_grey(const Scene& scene) {
    return std::all_of(
        scene.materials.begin(), scene.materials.end(), [](const Material& material) {
            const auto grey = [](const Rgb& x) { return x[0] == x[1] && x[1] == x[2]; };
            return grey(material.reflectance) && grey(material.exitance);
        });
}

}  // namespace patchlight
