#include "tests/server/small_solution.h"

#include "server/scene_json.h"

namespace patchlight::server {

Job small_job() {
    return read_scene_text(R"({
        "version": 1,
        "units": {"length": "cm", "light": "photometric"},
        "materials": {"lamp": {"reflectance": 0.5, "exitance": 100}, "grey": {"reflectance": 0.4}},
        "objects": [
            {"name": "lamp", "material": "lamp",
             "polygon": [[0,0,300],[0,100,300],[200,100,300],[200,0,300]]},
            {"name": "floor", "material": "grey",
             "polygon": [[0,0,0],[100,0,0],[100,100,0],[0,100,0]]}],
        "cameras": [{"name": "main", "eye": [50,50,500], "look_at": [50,50,0], "size": [4,3]}],
        "sensors": [{"name": "desk", "position": [50,50,80], "normal": [0,0,1]},
                    {"name": "plane", "normal": [0,0,1],
                     "grid": {"origin": [0,0,80], "u": [100,0,0], "v": [0,100,0],
                              "count": [2,1]}}],
        "solve": {"patch_size": 10}})");
}

Solution small_solution() {
    Solution solution;
    solution.settings.method = Method::gauss_seidel;
    solution.settings.engine = Engine::analytic;
    solution.settings.patch_size = 0.1;
    solution.settings.tolerance = 1e-4;
    solution.why = "small and open";
    for (const SurfaceIndex surface : {0u, 1u}) {
        Patch patch;
        patch.surface = surface;
        patch.area = surface == 0 ? 2.0 : 1.0;
        patch.centre = surface == 0 ? Vec3(1, 0.5, 3) : Vec3(0.5, 0.5, 0);
        solution.mesh.patches.push_back(patch);
    }
    solution.radiosity = {Rgb(103, 102, 101), Rgb(9, 8, 7)};
    solution.irradiance = {Rgb(6, 4, 2), Rgb(22.5, 20, 17.5)};
    solution.display.positions = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0)};
    solution.display.radiosity = {Rgb(9, 8, 7), Rgb(8, 7, 6), Rgb(7, 6, 5)};
    solution.display.triangles = {{0, 1, 2}};
    solution.display.patch = {1};
    solution.error.algebraic_bound = 5e-5;
    solution.error.of_object = {std::nullopt, 0.25};
    solution.energy = {Rgb(200, 200, 200), Rgb(10, 9, 8), Rgb(1, 1, 1), Rgb(189, 190, 191), 1e-9};
    solution.form_factors.measured = {0.1, 0.5, 0.3, 0.01, 0.02};
    solution.form_factors.repaired = {0.1, 0.4, 0.25, 0.001, 1e-8};
    solution.form_factors.rays = 1234;
    solution.form_factors.open = true;
    solution.convergence = {{1, 0.25, 0.5}, {2, 0.5, 0.01}};
    solution.objects = {
        {2.0, Rgb(103, 102, 101), Rgb(6, 4, 2), Rgb(200, 200, 200), Rgb(102, 101, 100),
         Rgb(104, 103, 102)},
        {1.0, Rgb(9, 8, 7), Rgb(22.5, 20, 17.5), Rgb(0, 0, 0), Rgb(7, 6, 5), Rgb(9, 8, 7)}};
    solution.sensors = {{Rgb(30, 20, 10), 0.5}, {Rgb(10, 10, 10), 0.1}, {Rgb(30, 30, 30), 0.1}};
    solution.findings = {{"open-enclosure", {"floor"}, "light escapes", "close it", 3}};
    return solution;
}

}  // namespace patchlight::server
