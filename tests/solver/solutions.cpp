#include "tests/solver/solutions.h"

#include <fstream>
#include <stdexcept>

namespace patchlight {

nlohmann::json solution_case(const std::string& id) {
    std::ifstream stream(PATCHLIGHT_PHYSICS_DATA "/solutions.json");
    const nlohmann::json whole = nlohmann::json::parse(stream);
    for (const auto& entry : whole["cases"])
        if (entry["id"] == id) return entry;
    throw std::logic_error("no case " + id);
}

}  // namespace patchlight
