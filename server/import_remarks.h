#pragma once

#include "server/files/imported_geometry.h"
#include "server/files/texture_mean.h"
#include "solver/scene/finding.h"

#include <string>
#include <vector>

namespace patchlight::server {

/// What became of the materials of a geometry file on their way into a scene: one finding of each
/// kind that names them all, however many there are.
class ImportRemarks {
  public:
    /// For each material that is taken from the file, with the means of its textures in it.
    void look_at(const FileMaterial& material, const PaintReport& textures = {});

    /// Of the object `path` that names `file`.
    std::vector<Finding> findings(const std::string& path, const std::string& file) const;

  private:
    using Names = std::vector<std::string>;  // of materials

    bool has_nameless_ = false;  // faces without a material
    Names without_reflectance_;
    Names too_bright_;
    Names averaged_;   // textures that count by their mean
    Names unpainted_;  // textures that are left out
    std::string why_unpainted_;
    Names transparent_;
    Names metals_;
};

}  // namespace patchlight::server
