#include "server/files/mtl_file.h"

#include "server/files/text_lines.h"
#include "server/wording.h"

namespace patchlight::server {
namespace {

/// One number stands for all three channels.
Rgb read_colour(TextLines& lines) {
    if (const std::string_view given = lines.rest();
        given.starts_with("spectral") || given.starts_with("xyz"))
        lines.reject("colours are read as r g b only, not as " + in_quotes(given));
    Rgb colour = Rgb::Constant(lines.number(brightest_file_radiance));
    if (!lines.at_end()) {
        colour[1] = lines.number(brightest_file_radiance);
        colour[2] = lines.number(brightest_file_radiance);
    }
    if ((colour < 0.0).any()) lines.reject("must be at least 0");
    return colour;
}

bool read_transparency(TextLines& lines) {
    if (lines.rest().starts_with("-halo")) lines.word();
    return lines.number(brightest_file_radiance) < 1.0;
}

void read_property(const std::string& key, TextLines& lines, FileMaterial& material) {
    if (key == "Kd") material.reflectance = read_colour(lines);
    if (key == "Ke") material.radiance = read_colour(lines);
    if (key == "map_Kd" || key == "map_Ke") material.has_texture = true;
    if (key == "map_Kd") material.has_reflectance_texture = true;
    if (key == "d") material.is_transparent = read_transparency(lines);
}

}  // namespace

std::vector<FileMaterial> read_mtl(std::string_view text, const std::string& file) {
    std::vector<FileMaterial> materials;
    TextLines lines(text, file);
    while (lines.next()) {
        const std::string key(lines.word());
        if (key == "newmtl") {
            if (lines.at_end()) lines.reject("'newmtl' needs a name");
            materials.emplace_back();
            materials.back().name = lines.rest();
        } else if (!materials.empty()) {
            read_property(key, lines, materials.back());
        } else if (key == "Kd" || key == "Ke") {
            lines.reject("'" + key + "' stands before any 'newmtl'");
        }
    }
    // Where a texture paints, Kd 0 is what exporters write for "see the texture", not black.
    for (FileMaterial& material : materials)
        if (material.has_reflectance_texture && material.reflectance &&
            (*material.reflectance == 0.0).all())
            material.reflectance.reset();
    return materials;
}

}  // namespace patchlight::server
