#pragma once

#include "solver/scene/scene.h"

#include <string>
#include <unordered_set>

namespace patchlight::server {

/// Adds materials to a scene beside those it declares, under names of their own.
class MaterialNames {
  public:
    explicit MaterialNames(Scene& scene);

    /// Adds a material; if its name is taken it gets a number: "white#2".
    MaterialIndex add(Material material);

  private:
    Scene& scene_;
    std::unordered_set<std::string> taken_;
};

}  // namespace patchlight::server
