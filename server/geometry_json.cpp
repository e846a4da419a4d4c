#include "server/geometry_json.h"

#include "server/json_vectors.h"
#include "server/wording.h"
#include "solver/scene/polygon_with_holes.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace patchlight::server {
namespace {

constexpr std::size_t most_surfaces = 4'000'000;  // in one scene; patches are limited by memory

void require_room(const JsonValue& geometry, const Scene& scene, std::size_t more) {
    if (scene.surfaces.size() + more > most_surfaces)
        geometry.reject("the scene would have " + std::to_string(scene.surfaces.size() + more) +
                        " polygons; the limit is " + std::to_string(most_surfaces));
}

/// Corners as they must run in the scene: a mirror turns a counter-clockwise polygon clockwise.
/// The first corner stays the first, so a quad off its plane is cut along the same diagonal.
void keep_front(const Placement& placement, std::vector<Vec3>& corners) {
    if (placement.to_scene.linear().determinant() < 0)
        std::reverse(corners.begin() + 1, corners.end());
}

void require_corners(const JsonValue& polygon) {
    if (polygon.size() < 3)
        polygon.reject("must have at least 3 corners, not " + std::to_string(polygon.size()));
}

std::vector<Vec3> read_vertices(const JsonValue& list, const Eigen::Affine3d& to_scene) {
    std::vector<Vec3> vertices;
    vertices.reserve(list.size());
    list.for_each_element(
        [&](const JsonValue& vertex) { vertices.push_back(read_point(vertex, to_scene)); });
    return vertices;
}

/// Whether faces use the numbers 1 to `vertex_count`, as other formats have it.
bool count_from_one(const JsonValue& faces, std::size_t vertex_count) {
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    std::int64_t most = 0;
    try {
        faces.for_each_element([&](const JsonValue& face) {
            face.for_each_element([&](const JsonValue& value) {
                const std::int64_t index = value.whole_number(0, std::int64_t{1} << 53);
                least = std::min(least, index);
                most = std::max(most, index);
            });
        });
    } catch (const InputError&) {
        return false;
    }
    return least == 1 && most == static_cast<std::int64_t>(vertex_count);
}

std::size_t read_index(const JsonValue& value, std::size_t vertex_count, const JsonValue& faces) {
    const std::int64_t index = value.whole_number(-(std::int64_t{1} << 53), std::int64_t{1} << 53);
    if (index < 0 || static_cast<std::size_t>(index) >= vertex_count)
        value.reject("vertex " + std::to_string(index) + " does not exist; there are " +
                     std::to_string(vertex_count) + " vertices, numbered from 0" +
                     (count_from_one(faces, vertex_count)
                          ? "; these faces seem to count from 1: take 1 off each number"
                          : ""));
    return static_cast<std::size_t>(index);
}

std::vector<Vec3> read_face(const JsonValue& face, const std::vector<Vec3>& vertices,
                            const JsonValue& faces) {
    require_corners(face);
    std::vector<std::size_t> used;
    std::vector<Vec3> corners;
    face.for_each_element([&](const JsonValue& value) {
        used.push_back(read_index(value, vertices.size(), faces));
        corners.push_back(vertices[used.back()]);
    });
    std::sort(used.begin(), used.end());
    const auto twice = std::adjacent_find(used.begin(), used.end());
    if (twice != used.end())
        face.reject("vertex " + std::to_string(*twice) + " is used twice in one face");
    return corners;
}

}  // namespace

void read_polygon(const JsonValue& body, const Placement& placement, Scene& scene) {
    const JsonValue polygon = body.at("polygon");
    require_room(polygon, scene, 1);
    require_corners(polygon);
    std::vector<Vec3> corners = read_vertices(polygon, placement.to_scene);
    keep_front(placement, corners);
    const auto list = body.find("holes");
    if (!list || list->size() == 0)
        return add_polygon(scene, placement.object, placement.material, 0, corners,
                           polygon.pointer());
    std::vector<std::vector<Vec3>> holes;
    list->for_each_element([&](const JsonValue& hole) {
        require_corners(hole);
        holes.push_back(read_vertices(hole, placement.to_scene));
    });
    add_polygon_with_holes(scene, placement.object, placement.material, 0, corners, holes,
                           list->pointer());
}

void read_mesh(const JsonValue& mesh, const Placement& placement, Scene& scene) {
    mesh.require_object({"vertices", "faces"});
    const JsonValue vertex_list = mesh.at("vertices");
    const JsonValue faces = mesh.at("faces");
    const std::vector<Vec3> vertices = read_vertices(vertex_list, placement.to_scene);
    if (faces.size() == 0) faces.reject("must have at least one face");
    require_room(faces, scene, faces.size());
    std::uint32_t number = 0;
    faces.for_each_element([&](const JsonValue& face) {
        std::vector<Vec3> corners = read_face(face, vertices, faces);
        keep_front(placement, corners);
        add_polygon(scene, placement.object, placement.material, number++, corners, face.pointer());
    });
}

}  // namespace patchlight::server
