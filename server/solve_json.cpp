#include "server/solve_json.h"

#include "server/input_errors.h"
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
void put_if_known(nlohmann::ordered_json& block, const char* key,
                  const std::optional<Number>& number) {
    if (number) block[key] = *number;
}

/// Reads a block key by key, so that what is wrong with one does not hide what is with another.
class KeyReader {
  public:
    explicit KeyReader(const JsonValue& block) : block_(block) {}

    template <typename Read>
    void operator()(const char* key, const Read& read) {
        if (const auto value = block_.find(key)) faults_.attempt([&] { read(*value); });
    }
    void throw_if_any() const { faults_.throw_if_any(); }

  private:
    const JsonValue& block_;
    FaultList faults_;
};

void read_sampling(KeyReader& each, double metres, SolveSettings& settings) {
    each("patch_size",
         [&](const JsonValue& value) { settings.patch_size = read_patch_size(value, metres); });
    each("rays", [&](const JsonValue& value) {
        settings.rays = static_cast<int>(value.whole_number(1, most_rays));
    });
    each("hemicube_resolution", [&](const JsonValue& value) {
        settings.hemicube_resolution = static_cast<int>(value.whole_number(2, most_hemicube_cells));
    });
    each("seed", [&](const JsonValue& value) { settings.seed = value.unsigned_number(); });
}

void read_limits(KeyReader& each, SolveSettings& settings) {
    each("tolerance",
         [&](const JsonValue& value) { settings.tolerance = value.number(between_zero_and_one); });
    each("max_iterations", [&](const JsonValue& value) {
        settings.max_iterations =
            static_cast<int>(value.whole_number(1, std::numeric_limits<int>::max()));
    });
    each("time_limit",
         [&](const JsonValue& value) { settings.time_limit = value.number(above_zero); });
    each("memory_limit", [&](const JsonValue& value) {
        settings.memory_limit = value.unsigned_number();
        if (*settings.memory_limit == 0) value.reject("must be above 0");
    });
}

}  // namespace

void read_solve(const JsonValue& block, double metres, SolveSettings& settings) {
    block.require_object({"solver", "form_factors", "accuracy", "patch_size", "rays",
                          "hemicube_resolution", "tolerance", "max_iterations", "ambient", "seed",
                          "time_limit", "memory_limit"});
    KeyReader each(block);
    each("accuracy",
         [&](const JsonValue& value) { settings.accuracy = value.number(between_zero_and_one); });
    each("solver", [&](const JsonValue& value) { settings.method = read_choice(value, methods); });
    each("form_factors",
         [&](const JsonValue& value) { settings.engine = read_choice(value, engines); });
    each("ambient", [&](const JsonValue& value) { settings.ambient = value.boolean(); });
    read_sampling(each, metres, settings);
    read_limits(each, settings);
    each.throw_if_any();
}

nlohmann::ordered_json solve_block(const SolveSettings& settings) {
    nlohmann::ordered_json block{{"solver", name_of(settings.method)},
                                 {"form_factors", name_of(settings.engine)}};
    put_if_known(block, "accuracy", settings.accuracy);
    put_if_known(block, "patch_size", settings.patch_size);
    put_if_known(block, "rays", settings.rays);
    put_if_known(block, "hemicube_resolution", settings.hemicube_resolution);
    put_if_known(block, "tolerance", settings.tolerance);
    put_if_known(block, "max_iterations", settings.max_iterations);
    put_if_known(block, "ambient", settings.ambient);
    block["seed"] = settings.seed;
    put_if_known(block, "time_limit", settings.time_limit);
    put_if_known(block, "memory_limit", settings.memory_limit);
    return block;
}

std::string name_of(Method method) { return choice_name(methods, method); }
std::string name_of(Engine engine) { return choice_name(engines, engine); }

}  // namespace patchlight::server
