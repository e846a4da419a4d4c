#include "server/unique_names.h"

#include "server/wording.h"

namespace patchlight::server {

std::string name_of_unnamed(std::size_t k) {
    std::string name = "#";
    return name += std::to_string(k);
}

void UniqueNames::claim(const std::string& name, const JsonValue& place) {
    if (!taken_.insert(name).second)
        place.reject("the name " + in_quotes(name) + " is given twice");
}

}  // namespace patchlight::server
