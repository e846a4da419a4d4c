#include "server/summary.h"

#include "server/result_json.h"
#include "server/sensor_summary.h"
#include "server/solve_json.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace patchlight::server {
namespace {

std::string share(double part, double whole) {
    return whole > 0.0 ? rounded(100.0 * part / whole) + " %" : "-";
}

std::string error_line(const Solution& solution) {
    const ErrorReport& error = solution.error;
    std::string line = "error:     ";
    if (error.estimate) line += "estimate " + rounded(*error.estimate);
    if (error.estimate && error.target)
        line += (error.met() ? ", within the " : ", not the ") + rounded(*error.target) + " asked";
    if (error.estimate) line += "; ";
    line += error.algebraic_bound
                ? "solver within " + rounded(*error.algebraic_bound) + " of its matrix"
                : "no bound";
    if (!solution.within_tolerance) line += " (tolerance not reached)";
    return line + "\n";
}

std::string energy_line(const Job& job, const EnergyReport& energy) {
    const double emitted = luminance(energy.emitted);
    const char* power = job.units.light == LightUnit::photometric ? " lm" : " W";
    return "energy:    " + rounded(emitted) + power + " emitted, " +
           share(luminance(energy.absorbed), emitted) + " absorbed, " +
           share(luminance(energy.backs), emitted) + " on backs, " +
           share(luminance(energy.escaped), emitted) + " escaped, defect " +
           rounded(energy.defect) + "\n";
}

std::string brightest_line(const Job& job, const Solution& solution) {
    const auto brighter = [](const ObjectReport& a, const ObjectReport& b) {
        return luminance(a.irradiance) < luminance(b.irradiance);
    };
    const auto most = std::max_element(solution.objects.begin(), solution.objects.end(), brighter);
    if (most == solution.objects.end()) return "";
    const auto number = static_cast<std::size_t>(most - solution.objects.begin());
    const char* unit = job.units.light == LightUnit::photometric ? " lx" : " W/m²";
    return "brightest: " + job.scene.objects.at(number).name + ", irradiance " +
           rounded(luminance(most->irradiance)) + unit + " on average\n";
}

std::string time_line(const JobResult& result) {
    const StageSeconds& stages = result.solution.seconds;
    return "time:      " + rounded(result.run.total_seconds) + " s (mesh " + rounded(stages.mesh) +
           ", form factors " + rounded(stages.form_factors) + ", solve " + rounded(stages.solve) +
           ", display " + rounded(stages.display) + "), threads " +
           std::to_string(result.run.threads) + ", peak memory " +
           memory_text(static_cast<double>(result.run.peak_memory)) + "\n";
}

}  // namespace

std::string rounded(double number) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g", number);
    return text.data();
}

std::string memory_text(double bytes) {
    if (bytes >= 1e18) return "more than any machine has";
    for (const char* unit : {" B", " kB", " MB", " GB"}) {
        if (bytes < 1000.0) return rounded(bytes) + unit;
        bytes /= 1000.0;
    }
    return rounded(bytes) + " TB";
}

std::string finding_lines(const std::vector<Finding>& findings) {
    if (findings.empty()) return "findings:  none\n";
    std::string lines;
    for (const Finding& finding : findings) {
        lines += "finding:   " + finding.kind;
        for (const std::string& object : finding.objects)
            lines += (&object == &finding.objects.front() ? " (" : ", ") + object;
        lines += (finding.objects.empty() ? ": " : "): ") + finding.detail;
        if (finding.count > 1) lines += ", " + std::to_string(finding.count) + " times";
        if (!finding.remedy.empty()) lines += "; " + finding.remedy;
        lines += "\n";
    }
    return lines;
}

std::string summary(const Job& job, const JobResult& result) {
    const Solution& solution = result.solution;
    const int iterations = solution.convergence.empty() ? 0 : solution.convergence.back().iteration;
    std::string lines =
        "status:    " + name_of(solution.status) + "\n" +  //
        "method:    " + name_of(solution.settings.method) + " on " +
        name_of(solution.settings.engine) + " form factors\n" + "why:       " + solution.why +
        "\n" + "size:      polygons " + std::to_string(job.scene.surfaces.size()) + ", patches " +
        std::to_string(solution.mesh.size()) + ", iterations " + std::to_string(iterations) + "\n";
    if (is_solved(solution))
        lines += error_line(solution) + energy_line(job, solution.energy) +
                 brightest_line(job, solution) +
                 sensor_lines(job, solution, result.document.at("grids"));
    return lines + time_line(result) + finding_lines(solution.findings);
}

}  // namespace patchlight::server
