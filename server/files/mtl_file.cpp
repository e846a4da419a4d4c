#include "server/files/mtl_file.h"

#include "server/files/text_lines.h"
#include "server/wording.h"

#include <charconv>

namespace patchlight::server {
namespace {

/// One number stands for all three channels.
Rgb read_mtl_colour(TextLines& lines) {
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

/// What says that light passes; several statements may speak of it.
struct Clarity {
    bool has_opacity = false;
    double opacity = 1.0;  // d [1]
    bool has_transparency = false;
    double transparency = 0.0;  // Tr: 1 - d where both are right [1]
    bool has_filter = false;
    Rgb filter = Rgb::Ones();  // Tf: what passes of the light that does [1]
    double model = -1.0;       // illum; below 0: not given
    bool has_map = false;      // of opacity
};

/// Exporters write Tf 1 1 1 beside opaque surfaces, too, so it says something only where nothing
/// else does.
bool lets_light_through(const Clarity& clarity) {
    if (clarity.has_map || (clarity.has_opacity && clarity.opacity < 1.0)) return true;
    if (!clarity.has_opacity && clarity.has_transparency && clarity.transparency > 0.0) return true;
    for (const double glass : {4.0, 6.0, 7.0, 9.0})
        if (clarity.model == glass) return true;
    if (!clarity.has_filter) return false;
    const bool passes_part = (clarity.filter > 0.0 && clarity.filter < 1.0).any();
    const bool is_alone = !clarity.has_opacity && !clarity.has_transparency && clarity.model < 0.0;
    return passes_part || (is_alone && (clarity.filter > 0.0).any());
}

bool reads_as_number(std::string_view word) {
    double number = 0.0;
    const auto read = std::from_chars(word.data(), word.data() + word.size(), number);
    return read.ec == std::errc() && read.ptr == word.data() + word.size();
}

/// Before the name of a picture stand options such as "-s 2 2 1 -clamp on": where it lies and how
/// it is drawn, which does not change its mean.
std::optional<FileTexture> read_texture(TextLines& lines) {
    while (lines.rest().starts_with('-')) {
        const std::string_view option = lines.word();
        const bool up_to_three = option == "-o" || option == "-s" || option == "-t";
        const std::size_t words = option == "-mm" ? 2 : 1;
        if (!up_to_three)
            for (std::size_t k = 0; k < words; ++k) lines.word();
        for (int k = 0; up_to_three && k < 3; ++k) {
            const std::string_view left = lines.rest();
            if (!reads_as_number(left.substr(0, left.find_first_of(" \t")))) break;
            lines.word();
        }
    }
    if (lines.rest().empty()) return std::nullopt;
    FileTexture texture;
    texture.name = lines.rest();
    return texture;
}

/// Of a spectrum is known only that there is one.
Rgb read_filter(TextLines& lines) {
    const bool is_spectrum =
        lines.rest().starts_with("spectral") || lines.rest().starts_with("xyz");
    return is_spectrum ? Rgb(Rgb::Constant(0.5)) : read_mtl_colour(lines);
}

void read_clarity(const std::string& key, TextLines& lines, Clarity& clarity) {
    if (lines.rest().starts_with("-halo")) lines.word();
    if (key == "d") {
        clarity.has_opacity = true;
        clarity.opacity = lines.number(brightest_file_radiance);
    }
    if (key == "tr") {
        clarity.has_transparency = true;
        clarity.transparency = lines.number(brightest_file_radiance);
    }
    if (key == "tf") {
        clarity.has_filter = true;
        clarity.filter = read_filter(lines);
    }
    if (key == "illum") clarity.model = lines.number(brightest_file_radiance);
    if (key == "map_d" || key == "map_tr" || key == "map_tf") clarity.has_map = true;
}

/// Keys are told apart by their letters alone, large or small, as exporters differ.
std::string small(std::string_view key) {
    std::string lowered(key);
    for (char& letter : lowered)
        if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
    return lowered;
}

void read_property(const std::string& key, TextLines& lines, FileMaterial& material) {
    if (key == "kd") material.reflectance = read_mtl_colour(lines);
    if (key == "ke") material.radiance = read_mtl_colour(lines);
    if (key == "map_kd") material.reflectance_texture = read_texture(lines);
    if (key == "map_ke") material.radiance_texture = read_texture(lines);
}

}  // namespace

std::vector<FileMaterial> read_mtl(std::string_view text, const std::string& file) {
    std::vector<FileMaterial> materials;
    Clarity clarity;  // of the last
    TextLines lines(text, file);
    while (lines.next()) {
        const std::string key = small(lines.word());
        if (key == "newmtl") {
            if (lines.rest().empty()) lines.reject("'newmtl' needs a name");
            materials.emplace_back();
            materials.back().name = lines.rest();
            clarity = {};
        } else if (!materials.empty()) {
            read_property(key, lines, materials.back());
            read_clarity(key, lines, clarity);
            materials.back().is_transparent = lets_light_through(clarity);
        } else if (key == "kd" || key == "ke") {
            lines.reject("'" + std::string(key == "kd" ? "Kd" : "Ke") +
                         "' stands before any 'newmtl'");
        }
    }
    // Where a texture paints, Kd 0 is what exporters write for "see the texture", not black.
    for (FileMaterial& material : materials)
        if (material.reflectance_texture && material.reflectance &&
            (*material.reflectance == 0.0).all())
            material.reflectance.reset();
    return materials;
}

}  // namespace patchlight::server
