#include "server/scene_results.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace patchlight::server {
namespace {

using Json = nlohmann::ordered_json;

std::size_t size_of(const SensorGrid& grid) {
    return static_cast<std::size_t>(grid.count_u) * static_cast<std::size_t>(grid.count_v);
}

/// Points that lie in a solid or outside the room are left out, and counted.
Json grid_result(const SensorGrid& grid, const Solution& solution) {
    const std::size_t count = size_of(grid);
    double least = std::numeric_limits<double>::infinity();
    double most = 0.0;
    double sum = 0.0;
    std::size_t left_out = 0;
    for (std::size_t k = grid.first; k < grid.first + count; ++k) {
        if (k < solution.misplaced.size() && solution.misplaced[k]) {
            ++left_out;
            continue;
        }
        const double illuminance = luminance(solution.sensors.at(k).irradiance);
        least = std::min(least, illuminance);
        most = std::max(most, illuminance);
        sum += illuminance;
    }
    Json result{{"name", grid.name}};
    if (left_out < count) {
        const double mean = sum / static_cast<double>(count - left_out);
        result.update({{"min", least}, {"mean", mean}, {"max", most}});
        if (mean > 0.0) result["uniformity"] = least / mean;
    }
    if (left_out > 0) result["left_out"] = left_out;
    return result;
}

}  // namespace

Json channels(const Rgb& quantity) { return {quantity[0], quantity[1], quantity[2]}; }

Json materials_block(const Scene& scene) {
    Json block = Json::object();
    for (const Material& material : scene.materials)
        block[material.name] = {{"reflectance", channels(material.reflectance)},
                                {"exitance", channels(material.exitance)},
                                {"two_sided", material.two_sided}};
    return block;
}

Json object_results(const Scene& scene, const Solution& solution) {
    std::vector<double> given(scene.objects.size(), 0.0);
    for (const Surface& surface : scene.surfaces) given[surface.object] += surface.area;
    constexpr double same = 1e-9;  // of the area: rounding of a mesh [1]
    Json list = Json::array();
    for (std::size_t k = 0; k < solution.objects.size(); ++k) {
        const ObjectReport& object = solution.objects[k];
        list.push_back({{"name", scene.objects.at(k).name},
                        {"area", object.area},
                        {"radiosity", channels(object.radiosity)},
                        {"irradiance", channels(object.irradiance)},
                        {"emitted", channels(object.emitted)},
                        {"min", channels(object.min)},
                        {"max", channels(object.max)}});
        if (std::abs(object.area - given[k]) > same * given[k])
            list.back()["area_given"] = given[k];
        if (k < solution.error.of_object.size() && solution.error.of_object[k])
            list.back()["error"] = *solution.error.of_object[k];
    }
    return list;
}

Json sensor_results(const Scene& scene, const Solution& solution) {
    Json list = Json::array();
    for (std::size_t k = 0; k < solution.sensors.size(); ++k) {
        const SensorReport& sensor = solution.sensors[k];
        list.push_back({{"name", scene.sensors.at(k).name},
                        {"position", channels(scene.sensors[k].position.array())},
                        {"irradiance", channels(sensor.irradiance)},
                        {"illuminance", luminance(sensor.irradiance)},
                        {"error", sensor.error}});
    }
    return list;
}

Json grid_results(const Scene& scene, const Solution& solution) {
    Json list = Json::array();
    for (const SensorGrid& grid : scene.grids)  // unless the work ended before all was gathered
        if (grid.first + size_of(grid) <= solution.sensors.size())
            list.push_back(grid_result(grid, solution));
    return list;
}

Json finding_list(const std::vector<Finding>& findings) {
    Json list = Json::array();
    for (const Finding& finding : findings) {
        Json entry{{"kind", finding.kind},
                   {"objects", finding.objects},
                   {"detail", finding.detail},
                   {"remedy", finding.remedy}};
        if (finding.count > 1) entry["count"] = finding.count;
        list.push_back(std::move(entry));
    }
    return list;
}

}  // namespace patchlight::server
