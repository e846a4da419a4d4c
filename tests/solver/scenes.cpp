#include "tests/solver/scenes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace patchlight {

Scene empty_scene() {
    Scene scene;
    scene.materials.resize(3);
    scene.materials[white].reflectance = Rgb::Constant(0.5);
    scene.materials[lamp].exitance = Rgb::Constant(1.0);
    scene.materials[two_sided].reflectance = Rgb::Constant(0.5);
    scene.materials[two_sided].two_sided = true;
    return scene;
}

ObjectIndex add(Scene& scene, const Polygon& polygon, MaterialIndex material) {
    const auto object = static_cast<ObjectIndex>(scene.objects.size());
    scene.objects.push_back({"#" + std::to_string(object)});
    add_polygon(scene, object, material, 0, polygon, "/objects/" + std::to_string(object));
    return object;
}

Scene scene_of(const Polygon& polygon) { return scene_of(std::vector<Polygon>{polygon}); }

Scene scene_of(const std::vector<Polygon>& polygons) {
    Scene scene = empty_scene();
    for (const Polygon& polygon : polygons) add(scene, polygon);
    return scene;
}

Polygon rectangle(const Vec3& origin, const Vec3& u, const Vec3& v) {
    return {origin, origin + u, origin + u + v, origin + v};
}

Polygon reversed(Polygon polygon) {
    std::reverse(polygon.begin(), polygon.end());
    return polygon;
}

Polygon flat(const std::vector<std::array<double, 2>>& corners) {
    Polygon polygon;
    for (const auto& [x, y] : corners) polygon.emplace_back(x, y, 0.0);
    return polygon;
}

Polygon regular(int corners, double radius, double z) {
    Polygon polygon;
    for (int k = 0; k < corners; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / corners;
        polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
    return polygon;
}

Polygon l_shape() { return flat({{0, 0}, {2, 0}, {2, 0.7}, {0.8, 0.7}, {0.8, 1.5}, {0, 1.5}}); }

Polygon star(int points, double inner) {
    Polygon polygon = regular(2 * points, 1.0);
    for (std::size_t k = 1; k < polygon.size(); k += 2) polygon[k] *= inner;
    return polygon;
}

Polygon comb(int teeth) {
    Polygon polygon;
    for (int k = 0; k <= 4 * teeth; ++k) polygon.emplace_back(0.5 * k, 0.0, 0.0);
    for (int k = teeth - 1; k >= 0; --k)
        for (const auto& [x, y] : {std::pair(2.0, 1.0),
                                   {1.5, 1.0},
                                   {1.0, 1.0},
                                   {1.0, 3.0},
                                   {0.5, 3.0},
                                   {0.0, 3.0},
                                   {0.0, 2.0}})
            polygon.emplace_back(2.0 * k + x, y, 0.0);
    return polygon;
}

Polygon spiral(int turns) {
    constexpr int per_turn = 12;
    Polygon outer, inner;
    for (int k = 0; k <= per_turn * turns; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / per_turn;
        const double radius = 1.0 + static_cast<double>(k) / per_turn;
        const Vec3 direction(std::cos(angle), std::sin(angle), 0.0);
        outer.push_back((radius + 0.4) * direction);
        inner.push_back(radius * direction);
    }
    outer.insert(outer.end(), inner.rbegin(), inner.rend());
    return outer;
}

Polygon random_outline(unsigned seed, int corners) {
    std::mt19937 chance(seed);
    Polygon polygon;
    for (int k = 0; k < corners; ++k) {
        const double angle = 2.0 * std::numbers::pi * (k + 0.8 * uniform(chance)) / corners;
        const double radius = 0.3 + 0.7 * uniform(chance);
        polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    }
    return polygon;
}

void add_box(Scene& scene, const Vec3& low, const Vec3& high, Facing facing) {
    const Vec3 size = high - low;
    const Vec3 x = size.x() * Vec3::UnitX(), y = size.y() * Vec3::UnitY(),
               z = size.z() * Vec3::UnitZ();
    const std::vector<Polygon> walls{rectangle(low, x, y), rectangle(low + z, y, x),
                                     rectangle(low, y, z), rectangle(low + x, z, y),
                                     rectangle(low, z, x), rectangle(low + y, x, z)};
    for (const Polygon& wall : walls) add(scene, facing == Facing::inwards ? wall : reversed(wall));
}

Scene room() {
    Scene scene = empty_scene();
    add_box(scene, Vec3::Zero(), Vec3::Ones(), Facing::inwards);
    return scene;
}

Scene room_with_box() {
    Scene scene = room();
    add_box(scene, Vec3(0.2, 0.3, 0.0), Vec3(0.55, 0.6, 0.5), Facing::outwards);
    return scene;
}

Eigen::Matrix3d odd_turn() {
    return Eigen::AngleAxisd(1.1, Vec3(0.3, -0.8, 0.5).normalized()).toRotationMatrix();
}

Polygon moved(const Polygon& polygon, const Motion& motion) {
    Polygon result;
    for (const Vec3& p : polygon) result.push_back(motion(p));
    return result;
}

Scene moved(const Scene& scene, const Motion& motion) {
    Scene result = scene;
    for (Surface& surface : result.surfaces) {
        surface.corners = moved(surface.corners, motion);
        surface.normal = motion.turn * surface.normal;
        surface.area *= motion.scale * motion.scale;
    }
    return result;
}

CutScene cut(const Scene& scene, double patch_size) {
    MeshLines lines = find_mesh_lines(scene);
    PatchMesh mesh = make_patches(scene, lines, patch_size);
    return {scene, std::move(lines), std::move(mesh)};
}

double uniform(std::mt19937& chance) { return static_cast<double>(chance()) * 0x1p-32; }

Vec3 random_direction(std::mt19937& chance) {
    const double z = 2.0 * uniform(chance) - 1.0, angle = 2.0 * std::numbers::pi * uniform(chance);
    const double radius = std::sqrt(1.0 - z * z);
    return {radius * std::cos(angle), radius * std::sin(angle), z};
}

Vec3 random_point(const PatchMesh& mesh, PatchIndex i, std::mt19937& chance) {
    const Patch& patch = mesh.patches[i];
    const Vec3 p = mesh.vertices[patch.vertices[0]];
    const Vec3 a = mesh.vertices[patch.vertices[1]] - p, b = mesh.vertices[patch.vertices[2]] - p,
               c = mesh.vertices[patch.vertices[3]] - p;
    const double first = a.cross(b).norm(), second = b.cross(c).norm();
    const bool in_first = uniform(chance) * (first + second) < first;
    const double root = std::sqrt(uniform(chance)), v = uniform(chance);
    return p + root * ((1.0 - v) * (in_first ? a : b) + v * (in_first ? b : c));
}

}  // namespace patchlight
