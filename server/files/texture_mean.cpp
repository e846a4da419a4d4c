#include "server/files/texture_mean.h"

#include "raster/mean_colour.h"
#include "server/files/file_bytes.h"
#include "server/utf8_text.h"
#include "server/wording.h"
#include "solver/scene/input_error.h"

#include <new>

namespace patchlight::server {

const TextureMeans::Mean& TextureMeans::mean_of(const FileTexture& texture, bool by_opacity) {
    const auto [found, is_new] = known_.try_emplace(
        {texture.path.string() + texture.name, texture.bytes.get(), by_opacity}, Mean{});
    Mean& mean = found->second;
    if (!is_new) return mean;
    mean.problem = in_quotes(texture.name) + " ";
    if (!texture.bytes && texture.path.empty()) {
        mean.problem += texture.problem;
        return mean;
    }
    try {
        const std::string read =
            texture.bytes ? std::string() : read_file_bytes(texture.path, texture.name);
        const Rgb colour = raster::mean_colour(texture.bytes ? *texture.bytes : read, by_opacity);
        mean.colour = colour.max(0.0).min(brightest_file_radiance);
        mean.problem.clear();
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        mean.problem += as_utf8(error.what());
    }
    return mean;
}

PaintReport TextureMeans::paint(FileMaterial& material) {
    PaintReport report;
    if (material.reflectance_texture) {
        const Mean& mean = mean_of(*material.reflectance_texture, material.is_transparent);
        if (mean.colour)
            material.reflectance = material.reflectance.value_or(Rgb::Ones()) * *mean.colour;
        report.is_averaged |= mean.colour.has_value();
        report.problem = mean.problem;
    }
    if (material.radiance_texture && (material.radiance == 0.0).all()) {
        report.problem = in_quotes(material.radiance_texture->name) +
                         " paints light, of which the material gives off none";
    } else if (material.radiance_texture) {
        constexpr bool by_opacity = false;
        const Mean& mean = mean_of(*material.radiance_texture, by_opacity);
        if (mean.colour) {
            material.radiance *= *mean.colour;
            material.radiance = material.radiance.min(brightest_file_radiance);
        }
        report.is_averaged |= mean.colour.has_value();
        if (!mean.colour) report.problem = mean.problem;
    }
    return report;
}

}  // namespace patchlight::server
