#include "server/solve_json.h"

#include "server/not_built.h"
#include "server/wording.h"

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

namespace patchlight::server {
namespace {

constexpr std::array<std::pair<const char*, Method>, 4> methods{
    {{"auto", Method::automatic},
     {"gauss-seidel", Method::gauss_seidel},
     {"shooting", Method::shooting},
     {"hierarchical", Method::hierarchical}}};
constexpr std::array<std::pair<const char*, Engine>, 4> engines{{{"auto", Engine::automatic},
                                                                 {"hemicube", Engine::hemicube},
                                                                 {"ray-cast", Engine::ray_cast},
                                                                 {"analytic", Engine::analytic}}};
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Range above_zero{0, infinity, true};
constexpr Range between_zero_and_one{0, 1, true, true};
constexpr int most_rays = 1 << 24;
constexpr int most_hemicube_cells = 4096;  // along the top face's edge

template <typename Choice, std::size_t count>
Choice read_choice(const JsonValue& value,
                   const std::array<std::pair<const char*, Choice>, count>& choices) {
    const std::string& asked = value.text();
    if (const std::string why = why_not_built(asked); !why.empty()) value.reject(why);
    std::vector<std::string> known;
    for (const auto& [name, choice] : choices) {
        if (asked == name) return choice;
        known.emplace_back(name);
    }
    value.reject("unknown choice " + in_quotes(asked) + suggestion(asked, known));
}

template <typename Choice, std::size_t count>
std::string choice_name(const std::array<std::pair<const char*, Choice>, count>& choices,
                        Choice wanted) {
    for (const auto& [name, choice] : choices)
        if (choice == wanted) return name;
    throw std::logic_error("a choice without a name");
}

double read_patch_size(const JsonValue& value, double metres) {
    constexpr double shortest = 1e-12;  // [m]
    const double patch_size = metres * value.number(above_zero);
    if (!(patch_size >= shortest && std::isfinite(patch_size)))
        value.reject("is " + number_text(patch_size) + " m; patches that small, or that large, " +
                     "cannot be made");
    return patch_size;
}

template <typename Number>
void put(nlohmann::ordered_json& block, const char* key, const std::optional<Number>& number) {
    if (number) block[key] = *number;
}

void read_limits(const JsonValue& block, SolveSettings& settings) {
    if (const auto time_limit = block.find("time_limit"))
        settings.time_limit = time_limit->number(above_zero);
    if (const auto memory_limit = block.find("memory_limit")) {
        settings.memory_limit = memory_limit->unsigned_number();
        if (*settings.memory_limit == 0) memory_limit->reject("must be above 0");
    }
}

}  // namespace

void read_solve(const JsonValue& block, double metres, SolveSettings& settings) {
    block.require_object({"solver", "form_factors", "accuracy", "patch_size", "rays",
                          "hemicube_resolution", "tolerance", "max_iterations", "ambient", "seed",
                          "time_limit", "memory_limit"});
    refuse_not_built(block, {"accuracy"});
    if (const auto solver = block.find("solver")) settings.method = read_choice(*solver, methods);
    if (const auto engine = block.find("form_factors"))
        settings.engine = read_choice(*engine, engines);
    if (const auto patch_size = block.find("patch_size"))
        settings.patch_size = read_patch_size(*patch_size, metres);
    if (const auto rays = block.find("rays"))
        settings.rays = static_cast<int>(rays->whole_number(1, most_rays));
    if (const auto resolution = block.find("hemicube_resolution"))
        settings.hemicube_resolution =
            static_cast<int>(resolution->whole_number(2, most_hemicube_cells));
    if (const auto ambient = block.find("ambient")) settings.ambient = ambient->boolean();
    if (const auto tolerance = block.find("tolerance"))
        settings.tolerance = tolerance->number(between_zero_and_one);
    if (const auto iterations = block.find("max_iterations"))
        settings.max_iterations =
            static_cast<int>(iterations->whole_number(1, std::numeric_limits<int>::max()));
    if (const auto seed = block.find("seed")) settings.seed = seed->unsigned_number();
    read_limits(block, settings);
}

nlohmann::ordered_json solve_block(const SolveSettings& settings) {
    nlohmann::ordered_json block{{"solver", name_of(settings.method)},
                                 {"form_factors", name_of(settings.engine)}};
    put(block, "accuracy", settings.accuracy);
    put(block, "patch_size", settings.patch_size);
    put(block, "rays", settings.rays);
    put(block, "hemicube_resolution", settings.hemicube_resolution);
    put(block, "tolerance", settings.tolerance);
    put(block, "max_iterations", settings.max_iterations);
    put(block, "ambient", settings.ambient);
    block["seed"] = settings.seed;
    put(block, "time_limit", settings.time_limit);
    put(block, "memory_limit", settings.memory_limit);
    return block;
}

std::string name_of(Method method) { return choice_name(methods, method); }
std::string name_of(Engine engine) { return choice_name(engines, engine); }

}  // namespace patchlight::server
