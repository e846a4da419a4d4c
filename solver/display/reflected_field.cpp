#include "solver/display/reflected_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace patchlight {

namespace {

constexpr double much_brighter = 3.0;    // than the mean of what is below: an excess [1]
constexpr double worth_sampling = 0.02;  // of all light, that the excess has [1]
constexpr double hardly_any = 1e-3;      // of all light, on what counts as dark [1]
constexpr int rounds = 6;                // of cutting the mean off at the threshold

struct LitCell {
    double y = 0.0, area = 0.0;
};

/// Area of all but the darkest cells, which hold hardly any light together: a wide ground that no
/// light reaches has no say in what the mean is. To a factor of 2 in brightness.
double lit_part(const std::vector<LitCell>& cells) {
    constexpr int lowest = -1100, bins = 2200;
    struct Bin {
        double light = 0.0, area = 0.0;
    };
    std::vector<Bin> by_exponent(bins);
    double light = 0.0;
    for (const LitCell& cell : cells) {
        if (!(cell.y > 0.0)) continue;
        Bin& bin = by_exponent[static_cast<std::size_t>(
            std::clamp(std::ilogb(cell.y) - lowest, 0, bins - 1))];
        bin.light += cell.area * cell.y;
        bin.area += cell.area;
        light += cell.area * cell.y;
    }
    double dark = 0.0, area = 0.0;
    for (const Bin& bin : by_exponent)
        if ((dark += bin.light) > hardly_any * light) area += bin.area;
    return area;
}

}  // namespace

ReflectedField::ReflectedField(const Scene& scene, const PatchMesh& mesh, const RayScene& rays,
                               const PatchLocator& locator, FieldTable table)
    : mesh_(mesh), rays_(rays), locator_(locator), table_(std::move(table)) {
    for (const Surface& surface : scene.surfaces) normals_.push_back(surface.normal.cast<float>());
    std::vector<LitCell> cells(table_.cells());
    for (PatchIndex i = 0; i < mesh.size(); ++i) {
        if (mesh.patches[i].covered) continue;
        const double area = table_.cell_area(i);
        for (std::size_t c = table_.first_cell(i); c < table_.end_cell(i); ++c) {
            cells[c] = {std::max(0.0, static_cast<double>(luminance_of(table_.value(c)))), area};
        }
    }
    const double whole = lit_part(cells);
    if (!(whole > 0.0)) return;
    double threshold = std::numeric_limits<double>::infinity(), all = 0.0, below = 0.0;
    for (int round = 0; round < rounds; ++round) {
        all = below = 0.0;
        for (const LitCell& cell : cells) {
            all += cell.area * cell.y;
            below += cell.area * std::min(cell.y, threshold);
        }
        threshold = much_brighter * below / whole;
    }
    if (!(all - below > worth_sampling * all)) return;
    threshold_ = static_cast<float>(threshold);
    double power = 0.0;
    for (PatchIndex i = 0; i < mesh.size(); ++i) {
        if (mesh.patches[i].covered) continue;
        for (std::size_t c = table_.first_cell(i); c < table_.end_cell(i); ++c) {
            const double excess = cells[c].y - static_cast<double>(threshold_);
            if (!(excess > 0.0)) continue;
            power += excess * cells[c].area;
            bright_.push_back({c, i, power});
        }
    }
    if (!(power > 0.0)) return;
    per_power_ = static_cast<float>(1.0 / power);
    guide_.reserve(bright_.size());
    std::uint32_t n = 0;
    for (std::size_t step = 0; step < bright_.size(); ++step) {
        const double at = power * static_cast<double>(step) / static_cast<double>(bright_.size());
        while (n + 1 < bright_.size() && bright_[n].power <= at) ++n;
        guide_.push_back(n);
    }
}

/// Where the cumulated power passes that share of all of it.
const ReflectedField::Bright& ReflectedField::bright_at(float pick) const {
    const double at = static_cast<double>(pick) * bright_.back().power;
    const auto step = static_cast<std::size_t>(pick * static_cast<float>(guide_.size()));
    std::uint32_t n = guide_[std::min(step, guide_.size() - 1)];
    while (n > 0 && bright_[n - 1].power > at) --n;  // beyond it by rounding
    while (n + 1 < bright_.size() && bright_[n].power <= at) ++n;
    return bright_[n];
}

ReflectedField::Sample ReflectedField::sample(float pick, float u, float v) const {
    const Bright& found = bright_at(pick);
    Sample sample;
    const SurfaceIndex s = mesh_.patches[found.patch].surface;
    const FieldTable::Spot spot = table_.spot(found.patch, found.cell, u, v);
    sample.normal = normals_[s];
    sample.frame = rays_.frame(s);
    sample.position = spot.position + rays_.lift(s) * sample.normal;
    sample.seen = seen(found.cell);
    sample.on_patch = spot.on_patch;
    return sample;
}

}  // namespace patchlight
