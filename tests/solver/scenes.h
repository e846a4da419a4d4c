#pragma once

#include "solver/mesh/make_patches.h"
#include "solver/rays/ray_scene.h"
#include "solver/scene/scene.h"

#include <random>
#include <vector>

namespace patchlight {

using Polygon = std::vector<Vec3>;

/// Materials every test scene starts with.
constexpr MaterialIndex white = 0;      // reflectance 0.5
constexpr MaterialIndex lamp = 1;       // exitance 1, reflectance 0
constexpr MaterialIndex two_sided = 2;  // reflectance 0.5
Scene empty_scene();

/// Adds the polygon as an object of its own, named "#k".
ObjectIndex add(Scene& scene, const Polygon& polygon, MaterialIndex material = white);
/// A scene of that polygon alone.
Scene scene_of(const Polygon& polygon);
Scene scene_of(const std::vector<Polygon>& polygons);

/// origin, origin + u, origin + u + v, origin + v; its front is where u × v points.
Polygon rectangle(const Vec3& origin, const Vec3& u, const Vec3& v);
Polygon reversed(Polygon polygon);
/// Corners (x, y, 0).
Polygon flat(const std::vector<std::array<double, 2>>& corners);
Polygon regular(int corners, double radius, double z = 0.0);
Polygon l_shape();
/// 2 * points corners, alternately at radius 1 and `inner`.
Polygon star(int points, double inner);
/// Teeth on a bar, with more corners than it needs along straight edges.
Polygon comb(int teeth);
/// A corridor that winds inwards: no point sees all of it.
Polygon spiral(int turns);
/// A star-shaped outline with random radii in [0.3, 1] at random angles.
Polygon random_outline(unsigned seed, int corners);

enum class Facing { inwards, outwards };
/// Six walls: bottom, top, then those at low x, high x, low y, high y.
void add_box(Scene& scene, const Vec3& low, const Vec3& high, Facing facing);
/// The unit cube from within.
Scene room();
/// The unit cube from within, with a closed box standing on its floor.
Scene room_with_box();

struct Motion {
    double scale = 1.0;
    Vec3 shift = Vec3::Zero();                           // after scaling [m]
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  // before scaling
    Vec3 operator()(const Vec3& p) const { return scale * (turn * p) + shift; }
};
Eigen::Matrix3d odd_turn();
Polygon moved(const Polygon& polygon, const Motion& motion);
Scene moved(const Scene& scene, const Motion& motion);

/// A scene, cut.
struct CutScene {
    Scene scene;
    MeshLines lines;
    PatchMesh mesh;
};
CutScene cut(const Scene& scene, double patch_size);

/// Uniform in [0, 1).
double uniform(std::mt19937& chance);
Vec3 random_direction(std::mt19937& chance);
/// Uniform over a convex patch.
Vec3 random_point(const PatchMesh& mesh, PatchIndex i, std::mt19937& chance);

}  // namespace patchlight
