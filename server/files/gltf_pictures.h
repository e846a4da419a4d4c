#pragma once

#include "server/files/gltf_accessors.h"
#include "server/files/imported_geometry.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>

namespace patchlight::server {

/// Finds the pictures that the textures of a glTF document show.
class GltfPictures {
  public:
    /// All have to outlive it. `path` is that of the file, which pictures may lie beside.
    GltfPictures(const JsonValue& root, const GltfAccessors& accessors,
                 const std::filesystem::path& path)
        : root_(root), accessors_(accessors), path_(path) {}

    /// What `info` refers to, such as {"index": 0}. One that is not there has a `problem`.
    FileTexture texture(const JsonValue& info);

  private:
    FileTexture picture(std::size_t image);

    const JsonValue& root_;
    const GltfAccessors& accessors_;
    const std::filesystem::path& path_;
    std::map<std::size_t, FileTexture> known_;  // by number of the image
};

}  // namespace patchlight::server
