#include "server/not_built.h"

#include <array>

namespace patchlight::server {
namespace {

struct Lack {
    std::string_view feature;
    std::string_view instead;
};

/// A line goes when its feature comes.
constexpr std::array lacks{
    Lack{"file", "give the geometry as `polygon` or `mesh`"},
    Lack{"definitions", "give the geometry as `polygon` or `mesh` where it stands"},
    Lack{"instance", "give the geometry as `polygon` or `mesh` where it stands"},
    Lack{"flux", "give the material an `exitance` or a `radiance`"},
    Lack{"hierarchical", "use `gauss-seidel` or `shooting`"},
    Lack{"accuracy", "set `patch_size` and `rays`"},
    Lack{"chart", "use `solve` or `check`"},
    Lack{"selftest", "use `solve` or `check`"},
    Lack{"serve", "use `solve` or `check`"},
    Lack{".obj", "give the geometry as `mesh` in a scene JSON"},
    Lack{".gltf", "give the geometry as `mesh` in a scene JSON"},
    Lack{".glb", "give the geometry as `mesh` in a scene JSON"},
    Lack{".stl", "give the geometry as `mesh` in a scene JSON"},
};

}  // namespace

std::string why_not_built(std::string_view feature) {
    for (const Lack& lack : lacks)
        if (lack.feature == feature)
            return std::string("`")
                .append(feature)
                .append("` is not built yet; ")
                .append(lack.instead);
    return "";
}

void refuse_not_built(const JsonValue& object, std::initializer_list<const char*> keys) {
    for (const char* key : keys)
        if (const auto member = object.find(key))
            if (const std::string why = why_not_built(key); !why.empty()) member->reject(why);
}

}  // namespace patchlight::server
