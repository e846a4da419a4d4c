#pragma once

#include "solver/mesh/patch_mesh.h"
#include "solver/scene/scene.h"

#include <Eigen/Core>

#include <vector>

namespace patchlight::server {

/// Colours that tell objects apart by their hue and patches of one object by their lightness,
/// linear sRGB. Hues of objects that follow each other are a golden section of the circle apart.
class PatchColours {
  public:
    PatchColours(const Scene& scene, const PatchMesh& mesh);

    const Eigen::Array3d& of(PatchIndex i) const { return colours_[i]; }

  private:
    std::vector<Eigen::Array3d> colours_;
};

}  // namespace patchlight::server
