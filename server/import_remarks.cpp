#include "server/import_remarks.h"

#include "server/wording.h"

namespace patchlight::server {
namespace {

/// "'a', 'b' and 3 more".
std::string listed(const std::vector<std::string>& names) {
    constexpr std::size_t most_listed = 10;
    std::string list;
    for (std::size_t k = 0; k < names.size() && k < most_listed; ++k)
        list += (k > 0 ? ", " : "") + in_quotes(names[k]);
    if (names.size() > most_listed)
        list += " and " + std::to_string(names.size() - most_listed) + " more";
    return list;
}

}  // namespace

void ImportRemarks::look_at(const FileMaterial& material, const PaintReport& textures) {
    if (material.name.empty() && !material.reflectance)
        has_nameless_ = true;
    else if (!material.reflectance)
        without_reflectance_.push_back(material.name);
    else if ((*material.reflectance >= 1.0).any())
        too_bright_.push_back(material.name);
    if (textures.is_averaged) averaged_.push_back(material.name);
    if (!textures.problem.empty()) {
        if (unpainted_.empty()) why_unpainted_ = textures.problem;
        unpainted_.push_back(material.name);
    }
    if (material.is_transparent) transparent_.push_back(material.name);
    if (material.is_metal) metals_.push_back(material.name);
}

std::vector<Finding> ImportRemarks::findings(const std::string& path,
                                             const std::string& file) const {
    std::vector<Finding> found;
    const auto tell = [&](const char* kind, const Names& names, const std::string& what,
                          const char* remedy) {
        if (!names.empty())
            found.push_back(
                {kind, {path}, "materials of " + file + " " + what + ": " + listed(names), remedy});
    };
    if (has_nameless_)
        found.push_back({"default-material",
                         {path},
                         "faces of " + file + " without a material are taken to reflect 0.5",
                         "give the object a `material`"});
    tell("default-material", without_reflectance_, "without a reflectance are taken to have 0.5",
         "give the object a `material`, or the scene materials of the same names");
    tell("reflectance-clamped", too_bright_, "that reflect all light or more are read as 0.99",
         "give them a reflectance below 1: white paint has about 0.85");
    tell("texture-averaged", averaged_, "have textures, of which the mean colours count",
         "nothing, unless bright and dark parts matter: then split the surface");
    tell("texture-ignored", unpainted_,
         "have textures that are left out (" + why_unpainted_ + "); plain colours count",
         "put the pictures beside the file, or give the materials their mean colours");
    tell("transparency-ignored", transparent_, "let light through; they are taken for opaque",
         "leave out what light should pass");
    tell("metal-as-diffuse", metals_, "are metals; all that they reflect is taken as diffuse",
         "give the scene materials of the same names, if they should be darker");
    return found;
}

}  // namespace patchlight::server
