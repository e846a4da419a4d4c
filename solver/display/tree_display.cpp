#include "solver/display/tree_display.h"

#include <Eigen/Geometry>

#include <map>
#include <unordered_map>

namespace patchlight {

namespace {

struct Builder {
    const Scene& scene;
    const PatchMesh& mesh;
    const RefinementTree& tree;
    const SplitIrradiance& arriving;
    TreeDisplay shown;
    struct Number {
        std::uint32_t look = RefinementTree::none, number = 0;
    };
    std::vector<std::uint32_t> looks = {};  // per surface: number of its object and material
    std::vector<Number> first_look = {};    // per vertex, as it first looked
    std::map<std::uint64_t, std::uint32_t> other_looks =
        {};  // (vertex, look), where it looks otherwise

    void number_looks() {
        std::unordered_map<std::uint64_t, std::uint32_t> found;
        for (const Surface& surface : scene.surfaces) {
            const std::uint64_t key =
                (std::uint64_t{surface.object} << 32) | std::uint64_t{surface.material};
            looks.push_back(
                found.try_emplace(key, static_cast<std::uint32_t>(found.size())).first->second);
        }
    }

    std::uint32_t add(const Vec3& position, const Rgb& direct, const Rgb& indirect,
                      PatchIndex patch) {
        const Material& material =
            scene.materials[scene.surfaces[mesh.patches[patch].surface].material];
        shown.display.positions.push_back(position);
        shown.display.radiosity.push_back(material.exitance +
                                          material.reflectance * (direct + indirect).max(0.0));
        shown.arriving.direct.push_back(direct);
        shown.arriving.indirect.push_back(indirect);
        return static_cast<std::uint32_t>(shown.display.positions.size() - 1);
    }

    std::uint32_t number(std::uint32_t v, PatchIndex patch) {
        const std::uint32_t look = looks[mesh.patches[patch].surface];
        const auto fresh = [&] {
            return add(tree.vertices()[v].position, arriving.direct[v], arriving.indirect[v],
                       patch);
        };
        if (first_look[v].look == RefinementTree::none) first_look[v] = {look, fresh()};
        if (first_look[v].look == look) return first_look[v].number;
        const std::uint64_t key = (std::uint64_t{v} << 32) | look;
        const auto found = other_looks.find(key);
        return found != other_looks.end() ? found->second
                                          : other_looks.emplace(key, fresh()).first->second;
    }

    void triangle(PatchIndex patch, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        shown.display.triangles.push_back({a, b, c});
        shown.display.patch.push_back(patch);
    }

    void leaf(const TreeElement& element) {
        std::vector<std::uint32_t> ring;
        const std::size_t n = element.corner_count();
        for (std::size_t k = 0; k < n; ++k) {
            ring.push_back(number(element.vertices[k], element.patch));
            if (const std::uint32_t m = tree.middle(element, k); m != RefinementTree::none)
                ring.push_back(number(m, element.patch));
        }
        const PatchIndex patch = element.patch;
        if (ring.size() == 3) {
            triangle(patch, ring[0], ring[1], ring[2]);
        } else if (ring.size() == 4 && n == 4) {  // along the diagonal with the smaller step
            const auto step = [&](std::size_t a, std::size_t b) {
                const auto& radiosity = shown.display.radiosity;
                return std::abs(luminance(radiosity[ring[a]] - radiosity[ring[b]]));
            };
            const std::size_t first = step(0, 2) <= step(1, 3) ? 0 : 1;
            triangle(patch, ring[first], ring[first + 1], ring[first + 2]);
            triangle(patch, ring[first], ring[first + 2], ring[(first + 3) % 4]);
        } else {
            fan(element, ring);
        }
    }

    /// Neighbours are finer: triangles from the middle to each part of the outline.
    void fan(const TreeElement& element, const std::vector<std::uint32_t>& ring) {
        Vec3 position = Vec3::Zero();
        Rgb direct = Rgb::Zero(), indirect = Rgb::Zero();
        const std::size_t n = element.corner_count();
        for (std::size_t k = 0; k < n; ++k) {
            position += tree.vertices()[element.vertices[k]].position / static_cast<double>(n);
            direct += arriving.direct[element.vertices[k]] / static_cast<double>(n);
            indirect += arriving.indirect[element.vertices[k]] / static_cast<double>(n);
        }
        const std::uint32_t middle = add(position, direct, indirect, element.patch);
        for (std::size_t k = 0; k < ring.size(); ++k)
            triangle(element.patch, middle, ring[k], ring[(k + 1) % ring.size()]);
    }
};

}  // namespace

TreeDisplay make_tree_display(const Scene& scene, const PatchMesh& mesh, const RefinementTree& tree,
                              const SplitIrradiance& arriving) {
    Builder builder{scene, mesh, tree, arriving, {}};
    builder.first_look.resize(tree.vertices().size());
    builder.number_looks();
    const auto triangles = [&] {
        return static_cast<std::uint32_t>(builder.shown.display.triangles.size());
    };
    builder.shown.first_triangle.reserve(tree.elements().size() + 1);
    for (const TreeElement& element : tree.elements()) {
        builder.shown.first_triangle.push_back(triangles());
        if (element.is_leaf()) builder.leaf(element);
    }
    builder.shown.first_triangle.push_back(triangles());
    return std::move(builder.shown);
}

SplitIrradiance patch_means(const TreeDisplay& shown, std::size_t patches) {
    SplitIrradiance sum{std::vector<Rgb>(patches, Rgb::Zero()),
                        std::vector<Rgb>(patches, Rgb::Zero())};
    std::vector<double> area(patches, 0.0);
    const DisplayMesh& display = shown.display;
    const auto mean = [](const std::vector<Rgb>& values, const std::array<std::uint32_t, 3>& at) {
        return Rgb((values[at[0]] + values[at[1]] + values[at[2]]) / 3.0);
    };
    for (std::size_t t = 0; t < display.triangles.size(); ++t) {
        const auto& at = display.triangles[t];
        const double twice = (display.positions[at[1]] - display.positions[at[0]])
                                 .cross(display.positions[at[2]] - display.positions[at[0]])
                                 .norm();
        const PatchIndex i = display.patch[t];
        sum.direct[i] += twice * mean(shown.arriving.direct, at);
        sum.indirect[i] += twice * mean(shown.arriving.indirect, at);
        area[i] += twice;
    }
    for (std::size_t i = 0; i < patches; ++i) {
        if (!(area[i] > 0.0)) continue;
        sum.direct[i] /= area[i];
        sum.indirect[i] /= area[i];
    }
    return sum;
}

}  // namespace patchlight
