#include "server/patches_csv.h"

#include "server/csv_table.h"

#include <stdexcept>

namespace patchlight::server {
namespace {

const char* side_name(Side side) {
    switch (side) {
        case Side::front:
            return "front";
        case Side::back:
            return "back";
    }
    throw std::logic_error("a side without a name");
}

}  // namespace

void write_patches_csv(const Scene& scene, const Solution& solution, const TextSink& sink) {
    CsvTable table(
        "index,object,material,side,x,y,z,nx,ny,nz,area,exitance_r,exitance_g,exitance_b,"
        "radiosity_r,radiosity_g,radiosity_b,irradiance_r,irradiance_g,irradiance_b",
        sink);
    for (std::size_t i = 0; i < solution.mesh.size(); ++i) {
        const Patch& patch = solution.mesh.patches[i];
        const Surface& surface = scene.surfaces.at(patch.surface);
        const Material& material = scene.materials.at(surface.material);
        table.number(i).text(scene.objects.at(surface.object).name).text(material.name);
        table.text(side_name(surface.side)).numbers(patch.centre).numbers(surface.normal);
        table.number(patch.area).numbers(material.exitance);
        table.numbers(solution.radiosity.at(i)).numbers(solution.irradiance.at(i));
        table.end_row();
    }
    table.finish();
}

}  // namespace patchlight::server
