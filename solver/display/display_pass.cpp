#include "solver/display/display_pass.h"

#include "solver/display/curved_mean.h"
#include "solver/display/fill_unknown.h"
#include "solver/display/find_apertures.h"
#include "solver/display/lamp_reach.h"

#include <algorithm>
#include <cmath>

namespace patchlight {

namespace {

/// Sources gathered from one by one: all of them in a room, a few in a building of many patches.
/// The rest are as good as bright walls to rays.
constexpr std::size_t fewest_sources = 8, most_sources = 10'000;
constexpr std::size_t most_source_pairs = 2'000'000'000;
constexpr int most_rays = 1 << 16;  // of one point
/// Of direct light: what takes more is hardly bends, and is measured before it is cut further.
constexpr std::size_t most_first_vertices = 100'000, most_times = 3;
constexpr std::size_t most_times_roots = 2;  // of indirect light's vertices, where roots are many
constexpr int most_levels = 14;              // gaps of a millimetre in walls of metres
constexpr double expected_miss = 0.5;  // of indirect light's target, however smooth it looks [1]
constexpr double of_records = 1.0;     // of indirect light's target: what they may miss [1]
constexpr int most_bend_cuts = 2;      // each leaves a quarter
constexpr double parabola_over_line = 8.0 / 15.0;  // mean square beside that in the middle [1]

std::size_t sources_for(std::size_t patches) {
    return std::clamp(most_source_pairs / std::max<std::size_t>(1, patches), fewest_sources,
                      most_sources);
}

/// A value per patch at the vertices of a tree: means of the patches round the roots' corners,
/// linear between.
std::vector<Rgb> spread(const RefinementTree& tree, const std::vector<Rgb>& of_patch) {
    std::vector<Rgb> values(tree.vertices().size(), Rgb::Zero());
    std::vector<double> count(tree.vertices().size(), 0.0);
    for (const TreeElement& element : tree.elements()) {
        if (element.level > 0) break;  // roots come first
        for (std::size_t k = 0; k < element.corner_count(); ++k) {
            values[element.vertices[k]] += of_patch[element.patch];
            count[element.vertices[k]] += 1.0;
        }
    }
    for (std::size_t v = 0; v < values.size(); ++v) {
        const TreeVertex& vertex = tree.vertices()[v];
        if (count[v] > 0.0) values[v] /= count[v];
        for (std::uint8_t k = 0; k < vertex.parent_count; ++k)
            values[v] += values[vertex.parents[k]] / static_cast<double>(vertex.parent_count);
    }
    return values;
}

}  // namespace

PointGather make_gather(const Scene& scene, const RayScene& rays, std::vector<LightSource> sources,
                        int most_samples, std::uint64_t seed,
                        const std::function<bool()>& search_on) {
    const std::vector<Aperture> apertures = find_apertures(
        scene, rays, sources, find_lamp_reach(scene, rays, sources, seed), seed, search_on);
    return PointGather(rays, std::move(sources), most_samples, apertures);
}

DisplayPass::DisplayPass(const Scene& scene, const PatchMesh& mesh, const RayScene& rays,
                         const MeshLines& lines, std::uint64_t seed, StopTokens stops)
    : scene_(scene),
      mesh_(mesh),
      rays_(rays),
      gather_(make_gather(scene, rays,
                          find_light_sources(scene, lines, rays, sources_for(mesh.size())),
                          most_rays, seed, stops.search_on)),
      points_(scene, mesh, rays, find_plane_groups(scene), gather_, seed, std::move(stops.go_on)),
      near_lights_(scene, mesh, rays, gather_.sources(), gather_.gaps()),
      spots_(scene, mesh, rays, gather_.sources(), gather_.gaps().all(), seed),
      tree_(mesh, find_flat_corners(mesh, find_plane_groups(scene))),
      roots_(tree_.vertices().size()),
      closer_(scene, mesh, tree_) {
    restart_direct();
    restart_indirect();
    for (const Patch& patch : mesh.patches) {
        if (!patch.covered) area_ += patch.area;
        weight_.push_back(
            scene.materials[scene.surfaces[patch.surface].material].reflectance.max(least_weight));
    }
}

bool DisplayPass::refine_direct(const Aim& aim, const DirectEffort& effort) {
    IrradianceLayer::Rule rule;
    rule.target = aim.target;
    // A shadow may lie between corners that see the source, and light between ones that do not.
    rule.must_cut = [&](const TreeElement& element) {
        return (element.area > area_ / aim.elements && points_.may_be_shaded(element.patch)) ||
               near_lights_.may_hide_spot(tree_, element, aim.target) ||
               spots_.may_hide_spot(tree_, element);
    };
    rule.follow = true;
    if (!gather_.gaps().empty()) rule.most_levels = most_levels;
    rule.most_vertices = std::max(most_first_vertices, most_times * direct_gathered_);
    const bool is_whole = direct_->refine(tree_, weight_, rule, [&](auto vertices) {
        return points_.direct(tree_, vertices, effort);
    });
    direct_gathered_ = std::max(direct_gathered_, direct_->gathered());
    return is_whole;
}

void DisplayPass::restart_direct() { direct_.emplace(tree_.vertices().size()); }

void DisplayPass::look_closer(std::span<const PointMiss> indirect) {
    closer_.add(tree_, indirect, [&](const TreeElement& e) { return indirect_->is_cut(tree_, e); });
}

void DisplayPass::restart_indirect() {
    indirect_.emplace(tree_.vertices().size());
    indirect_rays_ = 0;
}

bool DisplayPass::refine_indirect(const Aim& aim, const ReflectedField& field, int rays) {
    const auto gather = [&](int first) {
        return [this, &field, &aim, first, rays](std::span<const std::uint32_t> vertices) {
            return points_.indirect(tree_, vertices, field, first, rays,
                                    of_records * aim.target / std::sqrt(area_));
        };
    };
    if (indirect_rays_ > 0 && indirect_rays_ < rays &&
        !indirect_->join(gather(indirect_rays_), 1.0 - static_cast<double>(indirect_rays_) / rays))
        return false;
    indirect_rays_ = rays;
    IrradianceLayer::Rule rule;
    rule.target = aim.target;
    rule.must_cut = [&](const TreeElement& element) { return element.area > area_ / aim.elements; };
    rule.closer = &closer_;
    rule.most_vertices = std::max(rule.most_vertices, most_times_roots * roots_);
    rule.follow = !closer_.empty();
    if (!indirect_->refine(tree_, weight_, rule, gather(0))) return false;
    indirect_->smooth(tree_, weight_, expected_miss * aim.target / std::sqrt(area_));
    return true;
}

SplitIrradiance DisplayPass::at_all() const {
    const auto of = [&](const IrradianceLayer& layer, const std::vector<Rgb>& guess) {
        if (!layer.lacks_roots()) return layer.at_all(tree_);
        std::vector<Rgb> values = layer.at_all(tree_);
        fill_unknown(scene_, mesh_, tree_, layer.known(), guess, values);
        return values;
    };
    return {of(*direct_, guess_), of(*indirect_, {})};
}

void DisplayPass::show_bends(double missed) {
    for (int pass = 0; pass < most_bend_cuts; ++pass) {
        const SplitIrradiance arriving = at_all();
        std::vector<std::pair<double, std::uint32_t>> bent;  // square that is missed, and of which
        double sum = 0.0;
        for (std::uint32_t e = 0; e < tree_.elements().size(); ++e) {
            const double square = tree_.elements()[e].is_leaf() ? missed_bend(e, arriving) : 0.0;
            if (square > 0.0) bent.emplace_back(square, e);
            sum += square;
        }
        const double share = missed * missed / static_cast<double>(bent.size() + 1);
        if (sum <= missed * missed) return;
        for (const auto& [square, e] : bent)
            if (square > share) tree_.split(e);
    }
}

/// Square of what a leaf's triangles miss of the bend along its edges, over its area [W²/m²].
double DisplayPass::missed_bend(std::uint32_t leaf, const SplitIrradiance& arriving) const {
    const TreeElement& element = tree_.elements()[leaf];
    const std::size_t n = element.corner_count();
    double square = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
        const auto row = tree_.row(element, k);
        if (!row || tree_.middle(element, k) != RefinementTree::none) continue;
        const std::uint32_t a = element.vertices[k], b = element.vertices[(k + 1) % n];
        Rgb bent = Rgb::Zero();
        for (const std::vector<Rgb>* of : {&arriving.direct, &arriving.indirect})
            bent += bend(*row, (*of)[a], (*of)[b], *of);
        const double y = luminance(weight_[element.patch] * bent);
        square = std::max(square, y * y);
    }
    return parabola_over_line * square * element.area;
}

TreeDisplay DisplayPass::show(const std::vector<Rgb>& added) {
    tree_.balance();
    SplitIrradiance arriving = at_all();
    if (!added.empty()) {
        const std::vector<Rgb> more = spread(tree_, added);
        for (std::size_t v = 0; v < more.size(); ++v) arriving.indirect[v] += more[v];
    }
    return make_tree_display(scene_, mesh_, tree_, arriving);
}

}  // namespace patchlight
