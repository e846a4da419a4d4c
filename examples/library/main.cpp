// A room with a lamp panel in its ceiling, built in code: how bright is the table, where does the
// light go, and what does it look like? Light is given in lumens, so irradiance comes out in lux;
// the solver does not mind which unit of light it is.

#include "raster/image_file.h"
#include "raster/render.h"
#include "raster/write_whole.h"
#include "solver/scene/scene.h"
#include "solver/solve_scene.h"

#include <cstdio>
#include <exception>
#include <numbers>
#include <string>
#include <vector>

namespace {

using patchlight::Rgb;
using patchlight::Vec3;

patchlight::MaterialIndex add_material(patchlight::Scene& scene, const char* name,
                                       const Rgb& reflectance, const Rgb& exitance = Rgb::Zero()) {
    scene.materials.push_back({name, reflectance, exitance});
    return static_cast<patchlight::MaterialIndex>(scene.materials.size() - 1);
}

/// The parallelogram at `corner` between two edges, as an object of its own. It is seen from the
/// side that across × along points to; its back absorbs.
void add_panel(patchlight::Scene& scene, const char* name, patchlight::MaterialIndex material,
               const Vec3& corner, const Vec3& across, const Vec3& along) {
    scene.objects.push_back({name});
    const auto object = static_cast<patchlight::ObjectIndex>(scene.objects.size() - 1);
    const std::vector<Vec3> corners = {corner, corner + across, corner + across + along,
                                       corner + along};
    patchlight::add_polygon(scene, object, material, 0, corners, name);
}

/// 4 m wide (x), 3 m deep (y), 2.5 m high (z), with every front turned inwards.
patchlight::Scene make_room() {
    patchlight::Scene scene;
    const auto white = add_material(scene, "white", Rgb::Constant(0.7));
    const auto red = add_material(scene, "red", Rgb(0.6, 0.2, 0.15));
    const auto oak = add_material(scene, "oak", Rgb(0.4, 0.3, 0.2));
    const auto lamp = add_material(scene, "lamp", Rgb::Zero(), Rgb::Constant(4000.0));  // lm/m²

    const Vec3 x(4.0, 0.0, 0.0), y(0.0, 3.0, 0.0), z(0.0, 0.0, 2.5);
    add_panel(scene, "floor", oak, Vec3::Zero(), x, y);
    add_panel(scene, "ceiling", white, z, y, x);
    add_panel(scene, "left wall", red, Vec3::Zero(), y, z);
    add_panel(scene, "right wall", white, x, z, y);
    add_panel(scene, "near wall", white, Vec3::Zero(), z, x);
    add_panel(scene, "far wall", white, y, x, z);
    // It lies in the plane of the ceiling: of two polygons in one place the later one is seen.
    add_panel(scene, "lamp", lamp, Vec3(1.5, 1.0, 2.5), Vec3(0.0, 1.0, 0.0), Vec3(1.0, 0.0, 0.0));

    scene.sensors.push_back({"table", Vec3(2.0, 1.5, 0.75), Vec3::UnitZ()});
    return scene;
}

patchlight::raster::Image take_picture(const patchlight::DisplayMesh& display) {
    patchlight::raster::Camera camera;
    camera.eye = Vec3(3.6, 0.3, 1.6);
    camera.look_at = Vec3(0.8, 2.4, 1.1);
    camera.up = Vec3::UnitZ();
    camera.vertical_fov = 70.0;
    camera.width = 320;
    camera.height = 240;
    // A diffuse surface of radiosity B has the radiance B/π in every direction.
    std::vector<Eigen::Array3d> radiance;
    for (const Rgb& radiosity : display.radiosity) radiance.push_back(radiosity / std::numbers::pi);
    return patchlight::raster::render(camera, {display.positions, radiance, display.triangles});
}

void report(const patchlight::Scene& scene, const patchlight::Solution& solution) {
    std::printf("%zu patches; %s\n", solution.mesh.size(), solution.why.c_str());
    for (std::size_t k = 0; k < scene.sensors.size(); ++k)
        std::printf("%s: %.0f lux\n", scene.sensors[k].name.c_str(),
                    patchlight::luminance(solution.sensors[k].irradiance));
    std::printf("energy: %.1f lm emitted, %.1f lm absorbed, %.1f lm escaped, defect %.2g\n",
                patchlight::luminance(solution.energy.emitted),
                patchlight::luminance(solution.energy.absorbed),
                patchlight::luminance(solution.energy.escaped), solution.energy.defect);
}

}  // namespace

int main(int count, char** arguments) {
    const std::string picture = count > 1 ? arguments[1] : "room.pfm";
    try {
        const patchlight::Scene scene = make_room();
        patchlight::SolveSettings settings;
        settings.patch_size = 0.25;  // m; what is not set is chosen
        const patchlight::Solution solution = patchlight::solve_scene(
            scene, settings,
            [](const patchlight::Progress&) { return patchlight::Verdict::go_on; });
        report(scene, solution);
        patchlight::raster::write_whole(
            picture, patchlight::raster::encode_pfm(take_picture(solution.display)));
        std::printf("picture: %s\n", picture.c_str());
        return solution.status == patchlight::Status::converged ? 0 : 3;
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "%s\n", problem.what());
        return 1;
    }
}
