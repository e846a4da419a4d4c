#include "server/trace/row_picture.h"

#include "raster/colour_scale.h"
#include "raster/quantity_image.h"
#include "raster/scale_ticks.h"
#include "server/csv_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace patchlight::server {
namespace {

/// Patches as triangles of their own, each with one value all over.
struct FlatPatches {
    std::vector<Vec3> positions;
    std::vector<double> values;
    std::vector<std::array<std::uint32_t, 3>> triangles;

    template <class Value>
    FlatPatches(const PatchMesh& mesh, const Value& value) {
        for (PatchIndex i = 0; i < mesh.size(); ++i) {
            const Patch& patch = mesh.patches[i];
            if (patch.covered) continue;
            const auto first = static_cast<std::uint32_t>(positions.size());
            const auto corners = static_cast<std::uint32_t>(patch.corner_count());
            for (std::uint32_t k = 0; k < corners; ++k) {
                positions.push_back(mesh.vertices[patch.vertices[k]]);
                values.push_back(value(i));
            }
            for (std::uint32_t k = 1; k + 1 < corners; ++k)
                triangles.push_back({first, first + k, first + k + 1});
        }
    }
    raster::QuantityImage seen_by(const raster::Camera& camera) const {
        return raster::render_quantity(camera, positions, values, triangles);
    }
};

double most_shown(std::vector<double> factors) {
    constexpr double share = 0.99;  // the rest are neighbours, which would darken all others
    std::erase_if(factors, [](double factor) { return !(factor > 0.0); });
    if (factors.empty()) return 1.0;
    const auto last = static_cast<std::size_t>(share * static_cast<double>(factors.size() - 1));
    std::nth_element(factors.begin(), factors.begin() + static_cast<std::ptrdiff_t>(last),
                     factors.end());
    return raster::round_number_above(factors[last]);
}

}  // namespace

raster::Image row_picture(const PatchMesh& mesh, const PatchSight& sight,
                          const raster::Camera& camera) {
    const FlatPatches patches(mesh, [&](PatchIndex i) { return sight.factors[i]; });
    const raster::ShownRange range{0.0, most_shown(sight.factors)};
    raster::Image picture = raster::false_colour_image(patches.seen_by(camera), range);
    const FlatPatches own(mesh, [&](PatchIndex i) { return i == sight.patch ? 1.0 : 0.0; });
    const raster::QuantityImage mark = own.seen_by(camera);
    constexpr float light_grey = 0.9F;
    for (std::size_t k = 0; k < mark.quantity.size(); ++k)
        for (std::size_t c = 0; c < 3; ++c)
            picture.rgb[3 * k + c] += mark.quantity[k] * (light_grey - picture.rgb[3 * k + c]);
    return raster::with_colour_scale(picture, {range, {"form factor"}});
}

void write_row_csv(const Scene& scene, const PatchMesh& mesh, const PatchSight& sight,
                   const TextSink& sink) {
    CsvTable table("patch,object,x,y,z,area,factor,hemicube_factor", sink);
    for (PatchIndex j = 0; j < mesh.size(); ++j) {
        if (sight.factors[j] == 0.0 && sight.hemicube_factors[j] == 0.0) continue;
        const Patch& patch = mesh.patches[j];
        table.number(static_cast<std::size_t>(j));
        table.text(scene.objects[scene.surfaces[patch.surface].object].name);
        table.numbers(patch.centre).number(patch.area);
        table.number(sight.factors[j]).number(sight.hemicube_factors[j]).end_row();
    }
    table.finish();
}

}  // namespace patchlight::server
