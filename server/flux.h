#pragma once

#include "server/json_value.h"
#include "server/material_names.h"
#include "solver/scene/scene.h"

#include <string>
#include <unordered_set>

namespace patchlight::server {

/// Gives objects of a scene the power that their `flux` asks for.
class FluxSpreader {
  public:
    /// Both have to outlive it.
    FluxSpreader(Scene& scene, MaterialNames& names) : scene_(scene), names_(names) {}

    /// Of the surfaces from number `first` on, which are those of the object `path`, the ones that
    /// emit get the power `flux` in all [W or lm]: spread evenly over their area, both sides where
    /// they are two-sided. A number is the luminance of that power, in the colour each material
    /// has; a triple is the power of each channel. Parts that other polygons cover count with the
    /// area. A flux above another one overrides it. Each material concerned is copied under the
    /// name "material@path". Throws InputError if none of them emits.
    void spread(const JsonValue& flux, const std::string& path, SurfaceIndex first);

  private:
    bool emits(const Surface& surface) const;
    double emitting_area(SurfaceIndex first) const;
    MaterialIndex copy_of(MaterialIndex material, const std::string& path);

    Scene& scene_;
    MaterialNames& names_;
    std::unordered_set<MaterialIndex> copies_;
};

}  // namespace patchlight::server
