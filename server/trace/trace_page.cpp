#include "server/trace/trace_page.h"

#include "server/result_json.h"
#include "server/solve_json.h"
#include "server/summary.h"
#include "server/trace/hemicube_section.h"
#include "server/trace/html_text.h"

#include <algorithm>

namespace patchlight::server {
namespace {

constexpr const char* head = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>How it was solved</title><style>
body { font: 16px/1.5 sans-serif; max-width: 70rem; margin: 2rem auto; padding: 0 1rem; color: #222; }
h2 { margin-top: 2.5rem; } p { max-width: 46rem; } img { max-width: 100%; height: auto; }
.row { display: flex; flex-wrap: wrap; gap: 1rem; } figure { margin: 0; flex: 0 1 22rem; }
.wide figure { flex-basis: 34rem; } .cells img { image-rendering: pixelated; }
.pairs { display: grid; grid-template-columns: repeat(2, minmax(0, 24rem)); gap: 1rem; }
figcaption { font-size: 0.85rem; color: #444; } dt { font-weight: bold; } dd { margin: 0 0 0.4rem; }
</style></head><body>
)";

std::string entry(const std::string& term, const std::string& meaning) {
    return "<dt>" + term + "</dt><dd>" + html_text(meaning) + "</dd>\n";
}

std::string overview(const Trace& trace) {
    const Solution& solution = trace.result.solution;
    std::string page = "<h1>How " + html_text(trace.scene) + " was solved</h1>\n";
    page +=
        "<p>Every surface is cut into patches. Patch <i>i</i> sends off its own light and what it "
        "reflects of the light of all others: <i>B<sub>i</sub></i> = <i>E<sub>i</sub></i> + "
        "<i>&rho;<sub>i</sub></i> &Sigma;<sub><i>j</i></sub> <i>F<sub>ij</sub> B<sub>j</sub></i>, "
        "with radiosity <i>B</i>, exitance <i>E</i>, reflectance <i>&rho;</i>, and the form factor "
        "<i>F<sub>ij</sub></i>: the share of the light leaving <i>i</i> that arrives directly at "
        "<i>j</i> (Goral, Torrance, Greenberg &amp; Battaile, &ldquo;Modeling the interaction of "
        "light between diffuse surfaces&rdquo;, 1984).</p>\n<dl>";
    page +=
        entry("Method", name_of(solution.settings.method) + " on " +
                            name_of(solution.settings.engine) + " form factors. " + solution.why);
    page += entry("Size", std::to_string(trace.job.scene.surfaces.size()) + " polygons, " +
                              std::to_string(solution.mesh.size()) + " patches");
    page += entry("Status", name_of(solution.status));
    if (solution.error.estimate)
        page += entry("Error", "about " + rounded(*solution.error.estimate) +
                                   " of the reflected light, root mean square over all surfaces");
    return page + "</dl>\n";
}

constexpr const char* shooting_words =
    "<p>Progressive refinement (Cohen, Chen, Wallace &amp; Greenberg, &ldquo;A progressive "
    "refinement approach to fast radiosity image generation&rdquo;, 1988). At each step the patch "
    "with the most unshot light <i>A</i> &Delta;<i>B</i> shoots it at all others: patch <i>j</i> "
    "gains <i>&rho;<sub>j</sub></i> &Delta;<i>B<sub>i</sub> F<sub>ij</sub> A<sub>i</sub></i> / "
    "<i>A<sub>j</sub></i>, which it has to shoot in turn. One row of form factors is needed at a "
    "time, never the matrix; here up to eight of the brightest are computed together and then shot "
    "one by one. Lamps come first, then what they light most. The ambient term stands "
    "for the light still unshot, as if every patch saw the same mean surroundings: it is added to "
    "what is displayed and never to the solution, fades as the light is shot, and is why the first "
    "pictures are about as bright as the last.</p>\n";

constexpr const char* sweep_words =
    "<p>Gauss&ndash;Seidel on the stored matrix: each sweep gathers at every patch in turn the "
    "light of all others, with the values that this sweep has renewed already. It converges "
    "because a row sums to 1 at most and <i>&rho;</i> is below 1. Jacobi iteration, which uses "
    "none but the values of the sweep before, would show light bounce by bounce, one more in each "
    "picture; these sweeps run ahead of it, for light that has reached a patch goes on to those "
    "that come later in the same sweep.</p>\n";

constexpr const char* accuracy_words =
    "<p>A solve to an accuracy keeps its coarse solution to itself and shows what was gathered "
    "from it, so there are no steps to show. A solve set by hand shows them: no \"accuracy\" in "
    "the scene, and --patch-size given with --solver shooting or gauss-seidel.</p>\n";

/// What the solver had recorded of that step, if it had.
std::string state_after(const Solution& solution, int step) {
    for (const ConvergenceStep& recorded : solution.convergence)
        if (recorded.iteration == step)
            return recorded.unshot
                       ? ", " + rounded(100.0 * *recorded.unshot) + " % of the light unshot"
                       : ", residual " + rounded(recorded.residual);
    return "";
}

std::string steps(const Trace& trace) {
    const Solution& solution = trace.result.solution;
    const bool shoots = solution.settings.method == Method::shooting;
    std::string page = "<h2>Step by step</h2>\n";
    page += solution.settings.accuracy ? accuracy_words : shoots ? shooting_words : sweep_words;
    const bool pairs = !trace.steps.empty() && trace.steps.front().without_ambient.has_value();
    page += pairs ? "<div class=\"pairs\">\n" : "<div class=\"row\">\n";
    for (const StepPicture& step : trace.steps) {
        const std::string name = (shoots ? "shot " : "sweep ") + std::to_string(step.step);
        const std::string said = "After " + name + state_after(solution, step.step);
        if (step.without_ambient)
            page += html_figure(step_file(step, true), name + ", solution alone",
                                said + ": what has been shot so far") +
                    html_figure(step_file(step, false), name + ", with the ambient term",
                                "The same with the ambient term");
        else
            page += html_figure(step_file(step, false), name, said);
    }
    std::string last = "What the solve ended with";
    if (!solution.convergence.empty())
        last += ", after " + std::to_string(solution.convergence.back().iteration) +
                (shoots ? " shots" : " sweeps");
    if (solution.status == Status::cancelled) last += ", interrupted";
    return page + html_figure("last.png", "the last picture", last) + "</div>\n";
}

std::string convergence(const Trace& trace) {
    const Solution& solution = trace.result.solution;
    std::string page =
        "<h2>Convergence</h2>\n<p>The residual is what the equation above is still "
        "missed by: &Vert;<i>E</i> + <i>&rho;FB</i> &minus; <i>B</i>&Vert; / "
        "&Vert;<i>E</i>&Vert;, weighted by area, in the worst colour channel. ";
    page +=
        solution.settings.method == Method::shooting
            ? "Of a solution by shooting it is the unshot radiosity itself. The share unshot is "
              "&Sigma; <i>A</i> &Delta;<i>B</i> / &Sigma; <i>A E</i>; a shot takes from it "
              "what does not come back from the surfaces it meets."
            : "In a closed scene Jacobi iteration would bring it down to about the mean "
              "reflectance of what it was in each sweep; Gauss&ndash;Seidel brings it further.";
    page += solution.error.algebraic_bound
                ? " At the end the solution is proven to be within " +
                      rounded(*solution.error.algebraic_bound) + " of that of its matrix."
                : "";
    return page + " All numbers: <a href=\"convergence.csv\">convergence.csv</a>.</p>\n" +
           "<div class=\"row wide\">" +
           html_figure("convergence.svg", "residual over steps", "In decades") + "</div>\n";
}

}  // namespace

std::string trace_page(const Trace& trace) {
    return head + overview(trace) + steps(trace) + convergence(trace) + hemicube_section(trace) +
           "</body></html>\n";
}

}  // namespace patchlight::server
