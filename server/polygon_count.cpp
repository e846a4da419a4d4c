#include "server/polygon_count.h"

#include "server/wording.h"

#include <algorithm>

namespace patchlight::server {

std::size_t PolygonCount::of(const JsonValue& body) {
    if (const auto instance = body.find("instance")) return of_instance(*instance);
    if (const auto file = body.find("file")) return files_.open(*file).face_count();
    if (const auto mesh = body.find("mesh")) {
        const auto faces = mesh->find("faces");
        return faces ? std::min(faces->size(), too_many) : 0;
    }
    std::size_t count = body.has("polygon") ? 1 : 0;
    if (const auto children = body.find("children"))
        children->for_each_element(
            [&](const JsonValue& child) { count = std::min(count + of(child), too_many); });
    return count;
}

std::size_t PolygonCount::of_instance(const JsonValue& instance) {
    const std::string& name = instance.text();
    if (const auto found = known_.find(name); found != known_.end()) return found->second;
    if (const auto found = wrong_.find(name); found != wrong_.end()) throw found->second;
    try {
        const std::size_t count = of_definition(instance);
        open_.erase(name);
        return known_[name] = count;
    } catch (const InputError& error) {
        open_.erase(name);
        wrong_.emplace(name, error);
        throw;
    }
}

std::size_t PolygonCount::of_definition(const JsonValue& instance) {
    constexpr std::size_t deepest = 64;
    if (open_.size() >= deepest)
        instance.reject("definitions inside one another more than " + std::to_string(deepest) +
                        " deep");
    const JsonValue body = definitions_.body(instance);
    if (!open_.insert(instance.text()).second)
        instance.reject("the definition " + in_quotes(instance.text()) + " contains itself");
    // Counted as one at least, so that objects without polygons are limited, too.
    return std::max<std::size_t>(of(body), 1);
}

}  // namespace patchlight::server
