#include "server/files/gltf_materials.h"

#include "server/wording.h"

namespace patchlight::server {
namespace {

/// The first three of three or more numbers: a fourth is opacity.
Rgb read_colour(const JsonValue& value) {
    if (value.size() != 3 && value.size() != 4)
        value.reject("must have 3 or 4 numbers, not " + std::to_string(value.size()));
    constexpr Range range{0, brightest_file_radiance};
    return {value[0].number(range), value[1].number(range), value[2].number(range)};
}

double number_or(const JsonValue& block, const char* key, double otherwise) {
    const auto number = block.find(key);
    return number ? number->number({0, brightest_file_radiance}) : otherwise;
}

/// Reads the blocks of one material one after another.
class MaterialReader {
  public:
    MaterialReader(const JsonValue& block, GltfPictures& pictures)
        : block_(block), pictures_(pictures) {}

    FileMaterial read() {
        if (const auto name = block_.find("name")) material_.name = name->text();
        if (const auto surface = block_.find("pbrMetallicRoughness")) read_metallic(*surface);
        if (const auto emission = block_.find("emissiveFactor"))
            material_.radiance = read_colour(*emission);
        if (const auto texture = block_.find("emissiveTexture"))
            material_.radiance_texture = pictures_.texture(*texture);
        if (const auto extensions = block_.find("extensions")) read_extensions(*extensions);
        if ((material_.radiance > brightest_file_radiance).any())
            block_.reject("emits more than " + number_text(brightest_file_radiance));
        const auto mode = block_.find("alphaMode");
        material_.is_transparent |= mode && mode->text() != "OPAQUE";
        if (const auto both = block_.find("doubleSided")) material_.two_sided = both->boolean();
        return material_;
    }

  private:
    void read_metallic(const JsonValue& surface) {
        read_diffuse(surface, "baseColorFactor", "baseColorTexture");
        material_.is_metal = number_or(surface, "metallicFactor", 0.0) > 0.0 &&
                             !surface.has("metallicRoughnessTexture");
    }

    void read_diffuse(const JsonValue& surface, const char* factor, const char* painted) {
        if (const auto colour = surface.find(factor)) material_.reflectance = read_colour(*colour);
        if (const auto texture = surface.find(painted))
            material_.reflectance_texture = pictures_.texture(*texture);
    }

    /// Those that change what is diffuse or lets light through.
    void read_extensions(const JsonValue& extensions) {
        if (const auto strength = extensions.find("KHR_materials_emissive_strength"))
            material_.radiance *= number_or(*strength, "emissiveStrength", 1.0);
        if (const auto surface = extensions.find("KHR_materials_pbrSpecularGlossiness")) {
            material_.reflectance.reset();
            material_.reflectance_texture.reset();
            material_.is_metal = false;
            read_diffuse(*surface, "diffuseFactor", "diffuseTexture");
        }
        if (const auto glass = extensions.find("KHR_materials_transmission"))
            material_.is_transparent |= number_or(*glass, "transmissionFactor", 0.0) > 0.0;
        if (const auto paper = extensions.find("KHR_materials_diffuse_transmission"))
            material_.is_transparent |= number_or(*paper, "diffuseTransmissionFactor", 0.0) > 0.0;
    }

    const JsonValue& block_;
    GltfPictures& pictures_;
    FileMaterial material_;
};

}  // namespace

std::vector<FileMaterial> read_gltf_materials(const JsonValue& root, GltfPictures& pictures) {
    std::vector<FileMaterial> materials;
    if (const auto list = root.find("materials"))
        list->for_each_element([&](const JsonValue& block) {
            materials.push_back(MaterialReader(block, pictures).read());
        });
    materials.emplace_back();
    return materials;
}

}  // namespace patchlight::server
