#include "server/trace/hemicube_section.h"

#include "server/solve_json.h"
#include "server/summary.h"
#include "server/trace/html_text.h"

#include <cmath>

namespace patchlight::server {
namespace {

constexpr const char* top_delta =
    "&Delta;<i>F</i> = &Delta;<i>A</i> / <i>&pi;</i>(<i>x</i>&sup2; + <i>y</i>&sup2; + 1)&sup2;";
constexpr const char* side_delta =
    "&Delta;<i>F</i> = <i>z</i> &Delta;<i>A</i> / <i>&pi;</i>(<i>x</i>&sup2; + <i>z</i>&sup2; + "
    "1)&sup2;";

std::string place(const Vec3& p) {
    return "(" + rounded(p.x()) + ", " + rounded(p.y()) + ", " + rounded(p.z()) + ") m";
}

std::string row_words(const Trace& trace, const PatchSight& sight) {
    const Solution& solution = trace.result.solution;
    const Patch& patch = solution.mesh.patches[sight.patch];
    const std::string& object =
        trace.job.scene.objects[trace.job.scene.surfaces[patch.surface].object].name;
    double sum = 0.0;
    for (const double factor : sight.factors) sum += factor;
    return "<p>Patch " + std::to_string(sight.patch) + " of <b>" + html_text(object) + "</b> at " +
           place(patch.centre) + ", " + rounded(patch.area) +
           " m&sup2;, seen in light grey. The colours are the form factors <i>F<sub>ij</sub></i> "
           "from it to every other patch, by " +
           name_of(solution.settings.engine) + " form factors: where its light goes. They sum to " +
           rounded(sum) + "; " + rounded(100.0 * sight.backs) +
           " % of its light lands on backs and " + rounded(100.0 * sight.escaped) +
           " % leaves the scene, which makes 1 together. A large patch gets more than a small one "
           "beside it, and the few nearest may be beyond the scale. All numbers: <a "
           "href=\"row.csv\">row.csv</a>.</p>\n";
}

/// Half the sum of all differences: light that the one sends elsewhere than the other.
double sent_elsewhere(const PatchSight& sight) {
    double difference = 0.0;
    for (std::size_t j = 0; j < sight.factors.size(); ++j)
        difference += std::abs(sight.factors[j] - sight.hemicube_factors[j]);
    return 0.5 * difference;
}

std::string hemicube_words(const Trace& trace, const PatchSight& sight) {
    std::string words =
        "<p>Cohen &amp; Greenberg, &ldquo;The hemi-cube: a radiosity solution for complex "
        "environments&rdquo;, 1985: half a cube is put round the patch's centre, its five faces "
        "are "
        "drawn by an item buffer that keeps, of all patches behind a cell, the nearest, and the "
        "form "
        "factor to a patch is the sum of the delta form factors of the cells in which it is seen. "
        "Objects have a hue each, patches of one object differ in lightness; backs are dark grey, "
        "what leads out of the scene is black. ";
    if (trace.result.solution.settings.engine != Engine::hemicube)
        words += "This solve did not use it: its form factors are " +
                 name_of(trace.result.solution.settings.engine) + ". It is drawn to be looked at. ";
    else
        words +=
            "The solve turns each hemicube at random and uses several on a patch whose neighbours "
            "are near; this is a single one along the patch's edge. ";
    return words + "Beside the row above, this one hemicube of " +
           std::to_string(sight.faces[0].width) + " cells an edge sends " +
           rounded(100.0 * sent_elsewhere(sight)) +
           " % of the patch's light to other patches: it looks from one point (proximity, "
           "visibility), and a cell sees one patch only (aliasing).</p>\n";
}

}  // namespace

std::string hemicube_section(const Trace& trace) {
    if (!trace.sight)
        return "<h2>What one patch sees</h2>\n<p>The work was interrupted before this could be "
               "looked at.</p>\n";
    const PatchSight& sight = *trace.sight;
    std::string page = "<h2>A row of the form-factor matrix</h2>\n" + row_words(trace, sight);
    page += "<div class=\"row wide\">" +
            html_figure("row.png", "form factors in false colours",
                        "F<sub>ij</sub> from patch " + std::to_string(sight.patch)) +
            "</div>\n<h2>The hemicube of this patch</h2>\n" + hemicube_words(trace, sight) +
            "<div class=\"row wide cells\">" +
            html_figure("hemicube.png", "five faces of the hemicube, unfolded",
                        "The five faces folded out, as one who lies on the patch sees them") +
            html_figure("hemicube-delta.png", "delta form factors in false colours",
                        "Delta form factors: what a cell counts. Top: " + std::string(top_delta) +
                            ", sides: " + side_delta + ", divided by their sum") +
            "</div>\n<div class=\"row cells\">";
    constexpr const char* names[] = {"Top", "Towards +x, along the patch's first edge",
                                     "Towards &minus;x", "Towards +y", "Towards &minus;y"};
    for (std::size_t face = 0; face < 5; ++face)
        page += html_figure(face_file(face), "a face of the hemicube", names[face]);
    return page + "</div>\n";
}

}  // namespace patchlight::server
