#pragma once

#include "server/files/imported_geometry.h"

#include <map>
#include <optional>
#include <string>
#include <tuple>

namespace patchlight::server {

/// What became of the textures of a material.
struct PaintReport {
    bool is_averaged = false;  // at least one counts by its mean
    std::string problem;       // why another does not: "'wood.png' is no PNG, JPEG or EXR"
};

/// Replaces textures by their mean colours. A picture is read once, however often it is named; the
/// first loads the image module, which takes a quarter of a second.
class TextureMeans {
  public:
    /// Multiplies reflectance and radiance by the means of their textures; where a picture cannot
    /// be read, they stay as they are.
    PaintReport paint(FileMaterial& material);

  private:
    struct Mean {
        std::optional<Rgb> colour;  // linear light [1]
        std::string problem;        // why there is none
    };
    const Mean& mean_of(const FileTexture& texture, bool by_opacity);

    std::map<std::tuple<std::string, const void*, bool>, Mean> known_;
};

}  // namespace patchlight::server
