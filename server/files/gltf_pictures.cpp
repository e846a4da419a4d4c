#include "server/files/gltf_pictures.h"

#include "server/files/gltf_buffers.h"

namespace patchlight::server {
namespace {

/// The image of a texture, also where an extension has it in another format.
std::size_t image_of(const JsonValue& texture, const JsonValue& root) {
    if (const auto source = texture.find("source")) return gltf_index(*source, root, "images");
    if (const auto extensions = texture.find("extensions"))
        for (const char* name : {"KHR_texture_basisu", "EXT_texture_webp", "MSFT_texture_dds"})
            if (const auto extension = extensions->find(name))
                if (const auto source = extension->find("source"))
                    return gltf_index(*source, root, "images");
    texture.reject("needs 'source'");
}

}  // namespace

FileTexture GltfPictures::texture(const JsonValue& info) {
    FileTexture texture;
    try {
        const JsonValue reference = info.at("index");
        const JsonValue list = root_.at("textures");
        const JsonValue block = list[gltf_index(reference, root_, "textures")];
        const std::size_t image = image_of(block, root_);
        if (!known_.contains(image)) known_[image] = picture(image);
        return known_[image];
    } catch (const InputError& error) {
        texture.name = info.pointer();
        texture.problem = error.what();
    }
    return texture;
}

FileTexture GltfPictures::picture(std::size_t image) {
    FileTexture texture;
    const JsonValue list = root_.at("images");
    const JsonValue block = list[image];
    texture.name = block.pointer();
    if (const auto name = block.find("name")) texture.name = name->text();
    const auto uri = block.find("uri");
    if (const auto view = block.find("bufferView")) {
        texture.bytes = std::make_shared<const std::string>(accessors_.view(*view));
    } else if (uri && uri->text().starts_with("data:")) {
        texture.bytes = std::make_shared<const std::string>(read_data_uri(*uri));
    } else if (uri) {
        texture.name = uri->text();
        if (const auto found = file_of_uri(*uri, path_))
            texture.path = *found;
        else
            texture.problem = "does not lie beside the glTF file";
    } else {
        texture.problem = "has neither 'uri' nor 'bufferView'";
    }
    return texture;
}

}  // namespace patchlight::server
