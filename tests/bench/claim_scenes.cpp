#include "tests/bench/claim_scenes.h"

#include <array>
#include <stdexcept>

namespace patchlight {

std::span<const SceneClass> scene_classes() {
    static constexpr std::array<SceneClass, 12> classes{{{"slits", make_slits},
                                                         {"holes", make_holes},
                                                         {"white", make_white},
                                                         {"tessellated", make_tessellated},
                                                         {"lampshade", make_lampshade},
                                                         {"furniture", make_furniture},
                                                         {"doors", make_doors},
                                                         {"cove", make_cove},
                                                         {"tilted", make_tilted},
                                                         {"skypanel", make_skypanel},
                                                         {"boxes", make_boxes},
                                                         {"near", make_near}}};
    return classes;
}

std::string claim_scene(const std::string& name, std::uint64_t seed) {
    for (std::size_t k = 0; k < scene_classes().size(); ++k) {
        if (name != scene_classes()[k].name) continue;
        RoomParts parts(seed, 7000 + k);
        scene_classes()[k].make(parts);
        return parts.text.document();
    }
    throw std::invalid_argument("no class is named " + name);
}

}  // namespace patchlight
