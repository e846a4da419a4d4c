#pragma once

#include "server/json_value.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>

namespace patchlight::server {

enum class LightUnit : std::uint8_t { radiometric, photometric };

/// What the numbers of a scene are given in. Light travels the same in either unit of light: only
/// the labels differ.
struct Units {
    std::string length = "m";
    double metres = 1.0;  // in one unit of length [m]
    LightUnit light = LightUnit::radiometric;
};

/// The block `units` of a scene.
Units read_units(const JsonValue& block);

/// As it stands in a scene: {"length": "mm", "light": "radiometric"}.
nlohmann::ordered_json scene_units(const Units& units);

/// What each quantity of a result is in, by name: SI, whatever the scene was given in.
nlohmann::ordered_json result_units(const Units& units);

}  // namespace patchlight::server
