#pragma once

#include "solver/scene/finding.h"
#include "solver/scene/light.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace patchlight {

using MaterialIndex = std::uint32_t;
using ObjectIndex = std::uint32_t;
using SurfaceIndex = std::uint32_t;

struct Material {
    std::string name;
    Rgb reflectance = Rgb::Zero();  // share of arriving light sent back, in [0, 1) [1]
    Rgb exitance = Rgb::Zero();     // light the surface gives off by itself, all directions [W/m²]
    bool two_sided = false;         // the back reflects and emits as the front does
};

struct Object {
    std::string name;                     // path such as "chairs/chair-1"
    std::vector<std::size_t> findings{};  // numbers of those in Scene::findings noted of it alone
};

enum class Side : std::uint8_t { front, back };

/// A simple planar polygon, convex or not, that reflects and emits at its front: the side from
/// which `corners` run counter-clockwise. Its back absorbs.
struct Surface {
    std::vector<Vec3> corners;   // at least 3 [m]
    Vec3 normal = Vec3::Zero();  // unit, out of the front [1]
    double area = 0.0;           // [m²]
    MaterialIndex material = 0;
    ObjectIndex object = 0;
    std::uint32_t face = 0;        // number of the polygon, as given, within its object
    Side side = Side::front;       // `back`: the second half of a two-sided polygon
    bool cut_from_larger = false;  // a piece of a polygon much larger than what is near it
    double coarseness = 1.0;  // times as long as elsewhere its patches' edges may be: far geometry
};

/// A point at which irradiance is wanted.
struct Sensor {
    std::string name;
    Vec3 position = Vec3::Zero();  // [m]
    Vec3 normal = Vec3::UnitZ();   // unit; receives from this half space [1]
};

/// `count_u * count_v` consecutive sensors, number `first + j * count_u + i`.
struct SensorGrid {
    std::string name;
    std::size_t first = 0;
    int count_u = 1;
    int count_v = 1;
};

struct Scene {
    std::vector<Material> materials;
    std::vector<Object> objects;
    std::vector<Surface> surfaces;
    std::vector<Sensor> sensors;
    std::vector<SensorGrid> grids;
    std::vector<Finding> findings;  // what reading the geometry brought to light
};

/// Notes a finding about one object; met again, it is counted. The cost does not grow with the
/// number of findings.
void note(Scene& scene, ObjectIndex object, const Finding& finding);

/// Adds a polygon as it was given: one surface if it is planar to 1e-6 of its size, else the
/// triangles it is cut into (a quad along corners 0-2); each once more, reversed, if the material
/// is two-sided. A polygon without area is dropped and counted in `scene.findings`.
/// Throws InputError(pointer) if it crosses itself.
void add_polygon(Scene& scene, ObjectIndex object, MaterialIndex material, std::uint32_t face,
                 std::span<const Vec3> corners, const std::string& pointer);

/// Diagonal of the box round all surfaces [m].
double scene_size(const Scene& scene);

/// All reflectances and exitances are grey: one channel carries all three.
bool is_grey(const Scene& scene);

}  // namespace patchlight
