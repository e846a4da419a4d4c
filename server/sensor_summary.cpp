#include "server/sensor_summary.h"

#include "server/scene_results.h"
#include "server/summary.h"

#include <algorithm>
#include <vector>

namespace patchlight::server {
namespace {

constexpr std::size_t most_shown = 3;

std::string and_more(std::size_t count) {
    return count > most_shown ? ", and " + std::to_string(count - most_shown) + " more" : "";
}

/// Numbers of the sensors that are in no grid, among those that were gathered.
std::vector<std::size_t> single_sensors(const Scene& scene, std::size_t gathered) {
    std::vector<bool> is_single(scene.sensors.size(), true);
    for (const SensorGrid& grid : scene.grids) {
        const auto count =
            static_cast<std::size_t>(grid.count_u) * static_cast<std::size_t>(grid.count_v);
        for (std::size_t k = grid.first; k < grid.first + count; ++k) is_single[k] = false;
    }
    std::vector<std::size_t> numbers;
    for (std::size_t k = 0; k < std::min(gathered, is_single.size()); ++k)
        if (is_single[k]) numbers.push_back(k);
    return numbers;
}

std::string single_line(const Scene& scene, const Solution& solution, const std::string& unit) {
    const std::vector<std::size_t> singles = single_sensors(scene, solution.sensors.size());
    if (singles.empty()) return "";
    std::string line = "sensors:   ";
    for (std::size_t k = 0; k < std::min(singles.size(), most_shown); ++k)
        line += (k == 0 ? "" : ", ") + scene.sensors[singles[k]].name + " " +
                rounded(luminance(solution.sensors.at(singles[k]).irradiance)) + unit;
    return line + and_more(singles.size()) + "\n";
}

std::string grid_line(const nlohmann::ordered_json& grid, const std::string& unit) {
    const auto number = [&](const char* key) { return rounded(grid.at(key).get<double>()); };
    std::string line = "grid:      " + grid.at("name").get<std::string>();
    if (grid.contains("mean"))
        line += " " + number("min") + " to " + number("max") + unit + ", mean " + number("mean");
    if (grid.contains("uniformity")) line += ", uniformity " + number("uniformity");
    if (grid.contains("left_out"))
        line += ", points left out: " + std::to_string(grid.at("left_out").get<std::size_t>());
    return line;
}

}  // namespace

std::string sensor_lines(const Job& job, const Solution& solution,
                         const nlohmann::ordered_json& grids) {
    if (solution.sensors.empty()) return "";
    const std::string unit = job.units.light == LightUnit::photometric ? " lx" : " W/m²";
    std::string lines = single_line(job.scene, solution, unit);
    for (std::size_t k = 0; k < std::min(grids.size(), most_shown); ++k)
        lines += grid_line(grids[k], unit) +
                 (k + 1 == most_shown ? and_more(grids.size()) : std::string()) + "\n";
    return lines;
}

std::string sensor_lines(const Job& job, const Solution& solution) {
    return sensor_lines(job, solution, grid_results(job.scene, solution));
}

}  // namespace patchlight::server
