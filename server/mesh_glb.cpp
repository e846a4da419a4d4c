#include "server/mesh_glb.h"

#include "server/glb_container.h"
#include "server/object_meshes.h"
#include "server/scene_results.h"
#include "server/version.h"
#include "solver/display/vertex_irradiance.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <span>

namespace patchlight::server {
namespace {

using Json = nlohmann::ordered_json;
using Component = GlbContainer::Component;
using Target = GlbContainer::Target;

static_assert(std::endian::native == std::endian::little, "glTF buffers are little-endian");

constexpr std::size_t triple = 3 * sizeof(float);
constexpr std::size_t colour = 4 * sizeof(std::uint16_t);  // RGBA: a multiple of 4 bytes

std::array<float, 3> floats(const auto& numbers) {
    return {static_cast<float>(numbers[0]), static_cast<float>(numbers[1]),
            static_cast<float>(numbers[2])};
}

std::array<std::uint16_t, 4> shown_colour(const Rgb& radiosity, double gain) {
    constexpr double white = 65535.0;
    const Rgb light = (radiosity / std::numbers::pi * gain).max(0.0).min(1.0) * white;
    const auto rounded = [&](int c) { return static_cast<std::uint16_t>(std::lround(light[c])); };
    return {rounded(0), rounded(1), rounded(2), 65535};
}

/// What `of` gives for each vertex of each mesh, one after another.
template <class Of>
std::string bytes_of(const std::vector<ObjectMesh>& meshes, const Of& of) {
    std::string bytes;
    for (const ObjectMesh& mesh : meshes)
        for (const std::uint32_t vertex : mesh.vertices) {
            const auto element = of(vertex);
            bytes.append(reinterpret_cast<const char*>(element.data()), sizeof element);
        }
    return bytes;
}

std::string index_bytes(const std::vector<ObjectMesh>& meshes) {
    std::string bytes;
    for (const ObjectMesh& mesh : meshes)
        bytes.append(reinterpret_cast<const char*>(mesh.triangles.data()),
                     mesh.triangles.size() * sizeof mesh.triangles.front());
    return bytes;
}

struct Views {
    std::size_t position, colour, radiosity, irradiance, index;
};

Views add_views(GlbContainer& glb, const Scene& scene, const Solution& solution,
                const std::vector<ObjectMesh>& meshes, double exposure) {
    const DisplayMesh& display = solution.display;
    const std::vector<Rgb> irradiance = vertex_irradiance(scene, solution);
    const double gain = std::exp2(exposure);
    const auto add = [&](std::size_t stride, const auto& of) {
        return glb.add_view(bytes_of(meshes, of), stride, Target::vertices);
    };
    Views views{};
    views.position = add(triple, [&](auto v) { return floats(display.positions[v]); });
    views.colour = add(colour, [&](auto v) { return shown_colour(display.radiosity[v], gain); });
    views.radiosity = add(triple, [&](auto v) { return floats(display.radiosity[v]); });
    views.irradiance = add(triple, [&](auto v) { return floats(irradiance[v]); });
    views.index = glb.add_view(index_bytes(meshes), sizeof(std::uint32_t), Target::indices);
    return views;
}

/// The box round the positions as they are stored: viewers place their camera by it.
void add_bounds(Json& accessor, const DisplayMesh& display, const ObjectMesh& mesh) {
    std::array<float, 3> least = floats(display.positions[mesh.vertices.front()]);
    std::array<float, 3> most = least;
    for (const std::uint32_t vertex : mesh.vertices) {
        const std::array<float, 3> position = floats(display.positions[vertex]);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            least[axis] = std::min(least[axis], position[axis]);
            most[axis] = std::max(most[axis], position[axis]);
        }
    }
    accessor["min"] = least;
    accessor["max"] = most;
}

/// Vertices and indices that earlier meshes took of each view.
struct Taken {
    std::size_t vertices = 0;
    std::size_t indices = 0;
};

Json add_mesh(GlbContainer& glb, const Views& views, const Taken& taken, const ObjectMesh& mesh,
              const DisplayMesh& display) {
    const auto attribute = [&](std::size_t view, std::size_t size, Component component,
                               const char* type) {
        return glb.add_accessor(view, taken.vertices * size, component, mesh.vertices.size(), type);
    };
    const std::size_t position = attribute(views.position, triple, Component::f32, "VEC3");
    add_bounds(glb.document["accessors"][position], display, mesh);
    Json attributes{{"POSITION", position},
                    {"COLOR_0", attribute(views.colour, colour, Component::unit_u16, "VEC4")},
                    {"_RADIOSITY", attribute(views.radiosity, triple, Component::f32, "VEC3")},
                    {"_IRRADIANCE", attribute(views.irradiance, triple, Component::f32, "VEC3")}};
    const std::size_t indices =
        glb.add_accessor(views.index, taken.indices * sizeof(std::uint32_t), Component::u32,
                         3 * mesh.triangles.size(), "SCALAR");
    Json primitives = Json::array();
    primitives.push_back(
        {{"attributes", std::move(attributes)}, {"indices", indices}, {"material", 0}});
    return {{"primitives", std::move(primitives)}};
}

using Quaternion = std::array<double, 4>;  // x, y, z, w
constexpr Quaternion no_turn{0.0, 0.0, 0.0, 1.0};

/// The turn that brings the axis nearest to `up` to +Y: none, a quarter or a half.
Quaternion turn_upright(const Eigen::Vector3d& up) {
    Eigen::Index axis = 1;
    up.cwiseAbs().maxCoeff(&axis);
    const double sign = up[axis] < 0.0 ? -1.0 : 1.0;
    constexpr double half = 1.0 / std::numbers::sqrt2;  // sine and cosine of half a quarter turn
    if (axis == 0) return {0.0, 0.0, sign * half, half};
    if (axis == 2) return {-sign * half, 0.0, 0.0, half};
    return sign > 0.0 ? no_turn : Quaternion{1.0, 0.0, 0.0, 0.0};
}

Json head(const Job& job, double exposure) {
    const Json units = result_units(job.units);
    Json extras{{"exposure", exposure},
                {"radiosity", units.at("radiosity")},
                {"irradiance", units.at("irradiance")}};
    Json material{
        {"name", "light"},
        {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 1}}, {"metallicFactor", 0}}},
        {"doubleSided", false},
        {"extensions", {{"KHR_materials_unlit", Json::object()}}}};
    Json document{{"asset",
                   {{"version", "2.0"},
                    {"generator", std::string("patchlight ") + program_version()},
                    {"extras", std::move(extras)}}},
                  {"extensionsUsed", Json::array({"KHR_materials_unlit"})}};
    document["materials"].push_back(std::move(material));
    return document;
}

}  // namespace

std::string mesh_glb(const Job& job, const Solution& solution, double exposure) {
    const std::vector<ObjectMesh> meshes = object_meshes(job.scene, solution);
    GlbContainer glb;
    glb.document = head(job, exposure);
    Json roots = Json::array();
    if (!meshes.empty()) {
        const Views views = add_views(glb, job.scene, solution, meshes, exposure);
        const Quaternion turn = turn_upright(job.cameras.at(0).camera.up);
        Taken taken;
        for (const ObjectMesh& mesh : meshes) {
            const std::string& name = job.scene.objects[mesh.object].name;
            Json content = add_mesh(glb, views, taken, mesh, solution.display);
            content["name"] = name;
            roots.push_back(roots.size());
            glb.document["meshes"].push_back(std::move(content));
            Json node{{"name", name}, {"mesh", roots.size() - 1}};
            if (turn != no_turn) node["rotation"] = turn;
            glb.document["nodes"].push_back(std::move(node));
            taken.vertices += mesh.vertices.size();
            taken.indices += 3 * mesh.triangles.size();
        }
    }
    Json scene = Json::object();
    if (!roots.empty()) scene["nodes"] = std::move(roots);
    glb.document["scenes"].push_back(std::move(scene));
    glb.document["scene"] = 0;
    return glb.packed();
}

}  // namespace patchlight::server
