#include "tests/physics/rooms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <stdexcept>

namespace patchlight {

MaterialIndex SceneBuilder::material(double reflectance, double exitance) {
    scene.materials.push_back({"", Rgb::Constant(reflectance), Rgb::Constant(exitance), false});
    return static_cast<MaterialIndex>(scene.materials.size() - 1);
}

void SceneBuilder::polygon(const std::string& name, MaterialIndex material,
                           const std::vector<Vec3>& corners) {
    scene.objects.push_back({name});
    add_polygon(scene, static_cast<ObjectIndex>(scene.objects.size() - 1), material, 0, corners,
                "/objects");
}

void SceneBuilder::box(const std::string& name, MaterialIndex material, const Vec3& low,
                       const Vec3& high, bool inward, const Eigen::Isometry3d& pose, int skipped) {
    constexpr std::array<std::array<int, 4>, 6> outward{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    scene.objects.push_back({name});
    for (std::uint32_t face = 0; face < 6; ++face) {
        if (static_cast<int>(face) == skipped) continue;
        std::vector<Vec3> corners;
        for (const int k : outward[face])
            corners.push_back(pose * Vec3((k & 1) ? high.x() : low.x(),
                                          (k & 2) ? high.y() : low.y(),
                                          (k & 4) ? high.z() : low.z()));
        if (inward) std::reverse(corners.begin(), corners.end());
        add_polygon(scene, static_cast<ObjectIndex>(scene.objects.size() - 1), material, face,
                    corners, "/objects");
    }
}

void SceneBuilder::sensor(const Vec3& position, const Vec3& normal) {
    scene.sensors.push_back(
        {"s" + std::to_string(scene.sensors.size()), position, normal.normalized()});
}

Scene cornell_like(bool open) {
    SceneBuilder builder;
    const MaterialIndex white = builder.material(0.73, 0.0);
    constexpr int front = 2, none = -1;
    builder.box("room", white, {0, 0, 0}, {0.556, 0.5592, 0.5488}, true,
                Eigen::Isometry3d::Identity(), open ? front : none);
    builder.polygon("lamp", builder.material(0.78, 5.0),
                    {{0.213, 0.227, 0.5488},
                     {0.213, 0.332, 0.5488},
                     {0.343, 0.332, 0.5488},
                     {0.343, 0.227, 0.5488}});
    const auto block = [&](const char* name, double x, double y, double angle, double height) {
        const Eigen::Isometry3d pose(Eigen::Translation3d(x, y, 0.0) *
                                     Eigen::AngleAxisd(angle, Vec3::UnitZ()));
        builder.box(name, white, {-0.08, -0.08, 0}, {0.08, 0.08, height}, false, pose);
    };
    block("short", 0.186, 0.169, -0.29, 0.165);
    block("tall", 0.368, 0.351, 0.3, 0.33);
    return builder.scene;
}

std::vector<Way> every_way() {
    std::vector<Way> ways;
    for (const Engine engine : {Engine::analytic, Engine::ray_cast, Engine::hemicube})
        for (const Method method : {Method::gauss_seidel, Method::shooting})
            ways.push_back({engine, method});
    return ways;
}

std::string name_of(Engine engine) {
    switch (engine) {
        case Engine::analytic:
            return "Analytic";
        case Engine::ray_cast:
            return "RayCast";
        case Engine::hemicube:
            return "Hemicube";
        case Engine::automatic:
            break;
    }
    return "Automatic";
}

std::string way_name(const testing::TestParamInfo<Way>& info) {
    return name_of(info.param.engine) +
           (info.param.method == Method::shooting ? "Shooting" : "GaussSeidel");
}

SolveSettings settings_of(const Way& way) {
    SolveSettings settings;
    settings.engine = way.engine;
    settings.method = way.method;
    settings.tolerance = 1e-8;
    return settings;
}

void set_rays(SolveSettings& settings, int rays) {
    if (settings.engine == Engine::hemicube)
        settings.hemicube_resolution = static_cast<int>(std::lround(std::sqrt(rays)));
    else
        settings.rays = rays;
}

Solution solve(const Scene& scene, const SolveSettings& settings) {
    return solve_scene(scene, settings, {});
}

ObjectIndex scene_object(const Scene& scene, const Solution& solution, PatchIndex i) {
    return scene.surfaces[solution.mesh.patches[i].surface].object;
}

std::vector<std::uint32_t> object_vertices(const Scene& scene, const Solution& solution,
                                           ObjectIndex object) {
    std::vector<std::uint32_t> vertices;
    for (std::size_t t = 0; t < solution.display.triangles.size(); ++t)
        if (scene_object(scene, solution, solution.display.patch[t]) == object)
            vertices.insert(vertices.end(), solution.display.triangles[t].begin(),
                            solution.display.triangles[t].end());
    return vertices;
}

nlohmann::json reference(const std::string& file) {
    std::ifstream stream(std::string(PATCHLIGHT_PHYSICS_DATA) + "/" + file);
    return nlohmann::json::parse(stream);
}

nlohmann::json reference_case(const std::string& file, const std::string& id) {
    const nlohmann::json whole = reference(file);
    for (const auto& entry : whole["cases"])
        if (entry["id"] == id) return entry;
    throw std::logic_error("no case " + id);
}

Vec3 point_of(const nlohmann::json& array) {
    return {array[0].get<double>(), array[1].get<double>(), array[2].get<double>()};
}

std::vector<Vec3> points_of(const nlohmann::json& array) {
    std::vector<Vec3> points;
    for (const auto& p : array) points.push_back(point_of(p));
    return points;
}

}  // namespace patchlight
