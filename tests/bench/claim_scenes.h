#pragma once

#include "tests/bench/room_parts.h"

#include <cstdint>
#include <span>
#include <string>

namespace patchlight {

/// Kinds of scenes in which a claim about errors must hold.
struct SceneClass {
    const char* name;
    void (*make)(RoomParts& parts);
};
std::span<const SceneClass> scene_classes();

/// A scene document of a class. Throws std::invalid_argument for a class that is not there.
std::string claim_scene(const std::string& name, std::uint64_t seed);

// Light through gaps.
void make_slits(RoomParts& parts);
void make_holes(RoomParts& parts);
// Rooms by what is bright.
void make_white(RoomParts& parts);
void make_cove(RoomParts& parts);
void make_skypanel(RoomParts& parts);
// Rooms by shape.
void make_doors(RoomParts& parts);
void make_tilted(RoomParts& parts);
void make_boxes(RoomParts& parts);
// Things in rooms.
void make_tessellated(RoomParts& parts);
void make_lampshade(RoomParts& parts);
void make_furniture(RoomParts& parts);
void make_near(RoomParts& parts);

}  // namespace patchlight
