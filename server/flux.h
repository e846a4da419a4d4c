#pragma once

#include "server/input_errors.h"
#include "server/json_value.h"
#include "server/material_names.h"
#include "solver/scene/scene.h"

#include <string>
#include <unordered_set>
#include <vector>

namespace patchlight::server {

/// Gives objects of a scene the power that their `flux` asks for.
class FluxSpreader {
  public:
    /// Both have to outlive it.
    FluxSpreader(Scene& scene, MaterialNames& names) : scene_(scene), names_(names) {}

    /// Of the surfaces from number `first` on, which are those of the object `path`, the ones that
    /// emit will get the power `flux` in all [W or lm]: spread evenly over their area, both sides
    /// where they are two-sided. A number is the luminance of that power, in the colour each
    /// material has; a triple is the power of each channel. A flux above another one overrides it.
    /// Throws InputError if none of them emits.
    void ask(const JsonValue& flux, const std::string& path, SurfaceIndex first);

    /// Does so, once all objects are read: what other polygons cover takes no share. Each material
    /// concerned is copied under the name "material@path". It is a fault if all
    /// that emits of an object is covered.
    void spread_all(FaultList& faults);

  private:
    struct Wish {
        std::string pointer, path;
        Rgb power;                // [W or lm]
        bool coloured;            // power of each channel; else its luminance
        SurfaceIndex first, end;  // surfaces of the object
    };
    bool emits(const Surface& surface) const;
    void spread(const Wish& wish, const std::vector<double>& areas);
    MaterialIndex copy_of(MaterialIndex material, const std::string& path);

    Scene& scene_;
    MaterialNames& names_;
    std::vector<Wish> wishes_;
    std::unordered_set<MaterialIndex> copies_;
};

}  // namespace patchlight::server
