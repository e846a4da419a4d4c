#include "server/units.h"

#include "server/wording.h"

#include <array>
#include <utility>
#include <vector>

namespace patchlight::server {
namespace {

constexpr std::array<std::pair<const char*, double>, 5> lengths_in_metres{
    {{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}}};

void read_length(const JsonValue& value, Units& units) {
    std::vector<std::string> known;
    for (const auto& [name, metres] : lengths_in_metres) {
        if (value.text() == name) {
            units.length = name;
            units.metres = metres;
            return;
        }
        known.emplace_back(name);
    }
    value.reject("unknown unit of length " + in_quotes(value.text()) +
                 suggestion(value.text(), known));
}

LightUnit read_light(const JsonValue& value) {
    if (value.text() == "radiometric") return LightUnit::radiometric;
    if (value.text() == "photometric") return LightUnit::photometric;
    value.reject("unknown unit of light " + in_quotes(value.text()) +
                 suggestion(value.text(), {"radiometric", "photometric"}));
}

}  // namespace

Units read_units(const JsonValue& block) {
    block.require_object({"length", "light"});
    Units units;
    if (const auto length = block.find("length")) read_length(*length, units);
    if (const auto light = block.find("light")) units.light = read_light(*light);
    return units;
}

nlohmann::ordered_json scene_units(const Units& units) {
    const bool photometric = units.light == LightUnit::photometric;
    return {{"length", units.length}, {"light", photometric ? "photometric" : "radiometric"}};
}

nlohmann::ordered_json result_units(const Units& units) {
    const bool photometric = units.light == LightUnit::photometric;
    const char* given_off = photometric ? "lm/m²" : "W/m²";
    const char* received = photometric ? "lx" : "W/m²";
    const char* power = photometric ? "lm" : "W";
    return {{"length", "m"},
            {"area", "m²"},
            {"exitance", given_off},
            {"radiosity", given_off},
            {"irradiance", received},
            {"illuminance", received},
            {"radiance", photometric ? "cd/m²" : "W/(m² sr)"},
            {"emitted", power},
            {"energy", power}};
}

}  // namespace patchlight::server
