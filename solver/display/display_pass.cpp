#include "solver/display/display_pass.h"

#include <algorithm>

namespace patchlight {

namespace {

/// Sources gathered from one by one: all of them in a room, a few in a building of many patches.
/// The rest are as good as bright walls to rays.
constexpr std::size_t fewest_sources = 8, most_sources = 256;
constexpr std::size_t most_source_pairs = 4'000'000;
constexpr int most_rays = 1 << 16;  // of one point
constexpr std::size_t few_patches = 20'000;

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

DisplayPass::DisplayPass(const Scene& scene, const PatchMesh& mesh, const RayScene& rays,
                         const MeshLines& lines, std::uint64_t seed, std::function<bool()> go_on)
    : scene_(scene),
      mesh_(mesh),
      rays_(rays),
      gather_(rays, find_light_sources(scene, lines, rays, sources_for(mesh.size())), most_rays),
      points_(scene, mesh, rays, find_plane_groups(scene), gather_, seed, std::move(go_on)),
      tree_(mesh, find_flat_corners(mesh, find_plane_groups(scene))) {
    restart_direct();
    restart_indirect();
    for (const Patch& patch : mesh.patches)
        weight_.push_back(
            scene.materials[scene.surfaces[patch.surface].material].reflectance.max(least_weight));
}

bool DisplayPass::refine_direct(double target, const DirectEffort& effort) {
    IrradianceLayer::Rule rule;
    rule.target = target;
    // A shadow may lie between corners that see the source.
    if (mesh_.size() <= few_patches) {
        rule.least_levels = 2;
        rule.must_look = [&](PatchIndex i) { return points_.may_be_shaded(i); };
    }
    return direct_->refine(tree_, weight_, rule,
                           [&](auto vertices) { return points_.direct(tree_, vertices, effort); });
}

bool DisplayPass::refine_indirect(double target, const ReflectedField& field, int rays) {
    IrradianceLayer::Rule rule;
    rule.target = target;
    return indirect_->refine(tree_, weight_, rule, [&](auto vertices) {
        return points_.indirect(tree_, vertices, field, rays);
    });
}

TreeDisplay DisplayPass::show(const std::vector<Rgb>& added) {
    tree_.balance();
    SplitIrradiance arriving{direct_->at_all(tree_), indirect_->at_all(tree_)};
    if (!added.empty()) {
        const std::vector<Rgb> more = spread(tree_, added);
        for (std::size_t v = 0; v < more.size(); ++v) arriving.indirect[v] += more[v];
    }
    return make_tree_display(scene_, mesh_, tree_, arriving);
}

}  // namespace patchlight
