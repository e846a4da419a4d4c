#include "solver/transport/patch_fields.h"

namespace patchlight {

namespace {

const Material& material_of(const Scene& scene, const Patch& patch) {
    return scene.materials[scene.surfaces[patch.surface].material];
}

}  // namespace

PatchFields make_patch_fields(const Scene& scene, const PatchMesh& mesh) {
    PatchFields fields;
    const std::size_t channels = is_grey(scene) ? 1 : 3;
    fields.exitance.assign(channels, std::vector<double>(mesh.size()));
    fields.reflectance = fields.exitance;
    for (PatchIndex i = 0; i < mesh.size(); ++i) {
        fields.area.push_back(mesh.patches[i].area);
        const Material& material = material_of(scene, mesh.patches[i]);
        for (std::size_t c = 0; c < channels; ++c) {
            fields.exitance[c][i] = material.exitance[static_cast<Eigen::Index>(c)];
            fields.reflectance[c][i] = material.reflectance[static_cast<Eigen::Index>(c)];
        }
    }
    return fields;
}

std::vector<Rgb> to_rgb(const Field& field) {
    std::vector<Rgb> rgb(field[0].size());
    for (std::size_t i = 0; i < rgb.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
            rgb[i][static_cast<Eigen::Index>(c)] = field[field.size() == 1 ? 0 : c][i];
    return rgb;
}

std::vector<Rgb> exitances(const Scene& scene, const PatchMesh& mesh) {
    std::vector<Rgb> exitance;
    for (const Patch& patch : mesh.patches) exitance.push_back(material_of(scene, patch).exitance);
    return exitance;
}

}  // namespace patchlight
