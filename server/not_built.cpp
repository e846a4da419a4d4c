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
    Lack{"hierarchical", "use `gauss-seidel` or `shooting`"},
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
