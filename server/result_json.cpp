#include "server/result_json.h"

#include "server/cameras_json.h"
#include "server/form_factors_json.h"
#include "server/scene_results.h"
#include "server/sha256.h"
#include "server/solve_json.h"
#include "server/version.h"

#include <cmath>
#include <stdexcept>

namespace patchlight::server {
namespace {

using Json = nlohmann::ordered_json;

Json method_of(const Solution& solution) {
    return {{"solver", name_of(solution.settings.method)},
            {"form_factors", name_of(solution.settings.engine)},
            {"why", solution.why}};
}

Json settings_of(const Job& job, const Solution& solution) {
    Json cameras = Json::array();
    for (const NamedCamera& camera : job.cameras) cameras.push_back(camera_block(camera));
    return {{"units", scene_units(job.units)},
            {"materials", materials_block(job.scene)},
            {"cameras", std::move(cameras)},
            {"solve", solve_block(solution.settings)}};
}

Json error_of(const ErrorReport& error, const Scene& scene) {
    Json block = Json::object();
    if (error.target) block["target"] = *error.target;
    if (error.estimate) block["estimate"] = *error.estimate;
    if (error.algebraic_bound) block["algebraic_bound"] = *error.algebraic_bound;
    if (error.form_factors) block["form_factors"] = *error.form_factors;
    if (error.mesh) block["mesh"] = *error.mesh;
    if (error.target && error.estimate) block["met"] = error.met();
    if (const auto& check = error.transport)
        block["transport_check"] = {{"proven", check->proven},
                                    {"difference", check->difference},
                                    {"standard_error", check->standard_error},
                                    {"doubt", check->doubt},
                                    {"particles", check->particles},
                                    {"rays", check->rays}};
    if (error.estimate) block["of"] = "field";
    if (error.worst)
        block["worst_object"] = {{"name", scene.objects.at(error.worst->object).name},
                                 {"estimate", error.worst->estimate}};
    return block;
}

Json energy_of(const EnergyReport& energy) {
    return {{"emitted", channels(energy.emitted)},
            {"absorbed", channels(energy.absorbed)},
            {"backs", channels(energy.backs)},
            {"escaped", channels(energy.escaped)},
            {"defect", energy.defect},
            {"standard_error", energy.standard_error}};
}

Json convergence_of(const std::vector<ConvergenceStep>& steps) {
    Json list = Json::array();
    for (const ConvergenceStep& step : steps) {
        list.push_back({{"iteration", step.iteration},
                        {"seconds", step.seconds},
                        {"residual", step.residual}});
        if (step.unshot) list.back()["unshot"] = *step.unshot;
    }
    return list;
}

/// A picture that holds irradiance itself has a unit, but no colours.
Json false_colour_of(const FalseColourReport& report, const Units& units) {
    Json block = Json::object();
    if (report.is_mapped) block = {{"min", report.least}, {"max", report.most}};
    block["unit"] = result_units(units)["irradiance"];
    return block;
}

Json images_of(const std::vector<ImageReport>& images, const Units& units) {
    Json list = Json::array();
    for (const ImageReport& image : images) {
        Json entry{{"camera", image.camera},
                   {"content_type", image.content_type},
                   {"width", image.width},
                   {"height", image.height}};
        if (image.exposure) entry["exposure"] = *image.exposure;
        if (image.false_colour) entry["false_colour"] = false_colour_of(*image.false_colour, units);
        list.push_back(std::move(entry));
    }
    return list;
}

Json seconds_of(const StageSeconds& stages, const RunReport& report) {
    return {{"load", report.load_seconds},         {"mesh", stages.mesh},
            {"form_factors", stages.form_factors}, {"solve", stages.solve},
            {"display", stages.display},           {"render", report.render_seconds},
            {"total", report.total_seconds}};
}

void require_finite(const Json& value, const std::string& at = "") {
    if (value.is_number_float() && !std::isfinite(value.get<double>()))
        throw std::logic_error("a result that is not finite: " + at);
    if (value.is_structured())
        for (const auto& [key, element] : value.items()) require_finite(element, at + "/" + key);
}

}  // namespace

Json result_json(const Job& job, const Solution& solution, const RunReport& report) {
    Json result{{"version", 1},
                {"patchlight", program_version()},
                {"status", name_of(solution.status)},
                {"units", result_units(job.units)},
                {"settings", settings_of(job, solution)},
                {"method", method_of(solution)},
                {"patches", solution.mesh.size()},
                {"error", error_of(solution.error, job.scene)}};
    if (is_solved(solution)) {
        result["energy"] = energy_of(solution.energy);
        result["form_factors"] = form_factors_block(solution.form_factors);
    }
    result["convergence"] = convergence_of(solution.convergence);
    result["objects"] = object_results(job.scene, solution);
    result["sensors"] = sensor_results(job.scene, solution);
    result["grids"] = grid_results(job.scene, solution);
    result["images"] = images_of(report.images, job.units);
    result["findings"] = finding_list(solution.findings);
    result["seconds"] = seconds_of(solution.seconds, report);
    result["threads"] = report.threads;
    result["peak_memory_bytes"] = report.peak_memory;
    require_finite(result);
    result["result_hash"] = result_hash(result, solution.display);
    return result;
}

std::string result_hash(Json result, const DisplayMesh& display) {
    for (const char* varying : {"seconds", "threads", "peak_memory_bytes", "result_hash"})
        result.erase(varying);
    for (Json& step : result["convergence"]) step.erase("seconds");
    result["settings"]["solve"].erase("memory_limit");
    Sha256 sum;
    sum.add(result.dump());
    for (const Rgb& radiosity : display.radiosity)
        for (const double channel : radiosity) sum.add(channel);
    return sum.hex();
}

bool is_solved(const Solution& solution) { return !solution.convergence.empty(); }

std::string name_of(Status status) {
    switch (status) {
        case Status::converged:
            return "converged";
        case Status::limit:
            return "limit";
        case Status::cancelled:
            return "cancelled";
    }
    throw std::logic_error("a status without a name");
}

}  // namespace patchlight::server
