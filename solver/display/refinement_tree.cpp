#include "solver/display/refinement_tree.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace patchlight {

RefinementTree::RefinementTree(const PatchMesh& mesh, const FlatCorners& corners)
    : vertices_(corners.count) {
    for (PatchIndex i = 0; i < mesh.size(); ++i) {
        const Patch& patch = mesh.patches[i];
        if (patch.covered) continue;
        TreeElement element;
        element.vertices = corners.of_patch[i];
        element.patch = i;
        element.creases = corners.creases[i];
        element.area = patch.area;
        const std::size_t n = patch.corner_count();
        for (std::size_t k = 0; k < n; ++k) {
            TreeVertex& vertex = vertices_[element.vertices[k]];
            vertex.position = mesh.vertices[patch.vertices[k]];
            vertex.patch = i;
        }
        elements_.push_back(element);
    }
}

std::uint32_t RefinementTree::centre(const TreeElement& element) const {
    if (element.is_leaf() || element.is_triangle()) return none;
    return elements_[element.first_child].vertices[2];
}

std::uint32_t RefinementTree::make_middle(const TreeElement& element, std::size_t k) {
    const Edge edge = edge_of(element, k);
    if (const std::uint32_t found = middles_.find(edge); found != none) return found;
    TreeVertex vertex;
    vertex.position = 0.5 * (vertices_[edge.a].position + vertices_[edge.b].position);
    vertex.patch = element.patch;
    vertex.parents = {edge.a, edge.b, 0, 0};
    vertex.parent_count = 2;
    vertex.row = row(element, k);
    const auto number = static_cast<std::uint32_t>(vertices_.size());
    middles_.add(edge, number);
    vertices_.push_back(vertex);
    return number;
}

/// The edge from a to b is half of one that ends beyond b, or of the line across a quad whose
/// middle is b.
std::optional<VertexRow> RefinementTree::row_past(std::uint32_t a, std::uint32_t b) const {
    const TreeVertex& middle = vertices_[b];
    for (std::size_t k = 0; k < middle.parent_count; ++k)
        if (middle.parents[k] == a)
            return VertexRow{a, b, middle.parents[middle.parent_count == 2 ? 1 - k : (k + 2) % 4]};
    return std::nullopt;
}

/// The edge between the middles of two edges of a triangle is like half of its third edge.
std::optional<VertexRow> RefinementTree::row_inside_triangle(std::uint32_t a, std::uint32_t b,
                                                             PatchIndex patch) const {
    const TreeVertex &p = vertices_[a], &q = vertices_[b];
    if (p.parent_count != 2 || q.parent_count != 2) return std::nullopt;
    for (std::size_t k = 0; k < 2; ++k)
        for (std::size_t l = 0; l < 2; ++l) {
            if (p.parents[k] != q.parents[l]) continue;
            const std::uint32_t c = p.parents[1 - k], d = q.parents[1 - l];
            for (const std::uint32_t owner : {0u, patch + 1})
                if (const std::uint32_t found =
                        middles_.find({std::min(c, d), std::max(c, d), owner});
                    found != none)
                    return VertexRow{c, found, d};
        }
    return std::nullopt;
}

std::optional<VertexRow> RefinementTree::row(const TreeElement& element, std::size_t k) const {
    const Edge edge = edge_of(element, k);
    if (const auto past = row_past(edge.a, edge.b)) return past;
    if (const auto past = row_past(edge.b, edge.a)) return past;
    return row_inside_triangle(edge.a, edge.b, element.patch);
}

void RefinementTree::add_child(const TreeElement& parent,
                               const std::array<std::uint32_t, 4>& vertices, std::uint8_t creases) {
    TreeElement child;
    child.vertices = vertices;
    child.patch = parent.patch;
    child.creases = creases;
    child.level = static_cast<std::uint8_t>(parent.level + 1);
    const auto at = [&](std::size_t k) { return vertices_[vertices[k]].position; };
    Vec3 twice = (at(1) - at(0)).cross(at(2) - at(0));
    if (!child.is_triangle()) twice += (at(2) - at(0)).cross(at(3) - at(0));
    child.area = 0.5 * twice.norm();
    elements_.push_back(child);
}

void RefinementTree::split(std::uint32_t number) {
    if (!elements_[number].is_leaf()) return;
    const TreeElement parent = elements_[number];
    elements_[number].first_child = static_cast<std::uint32_t>(elements_.size());
    const auto& v = parent.vertices;
    const std::size_t n = parent.corner_count();
    std::array<std::uint32_t, 4> m{};
    for (std::size_t k = 0; k < n; ++k) m[k] = make_middle(parent, k);
    const auto outer = [&](std::size_t k, std::uint8_t as) {
        return static_cast<std::uint8_t>(((parent.creases >> k) & 1u) << as);
    };
    if (n == 3) {
        for (std::size_t k = 0; k < 3; ++k)  // corner, middle ahead, middle behind
            add_child(parent, {v[k], m[k], m[(k + 2) % 3], m[(k + 2) % 3]},
                      outer(k, 0) | outer((k + 2) % 3, 2));
        add_child(parent, {m[0], m[1], m[2], m[2]}, 0);
        return;
    }
    TreeVertex centre;
    for (const std::uint32_t corner : v) centre.position += 0.25 * vertices_[corner].position;
    centre.patch = parent.patch;
    centre.parents = m;
    centre.parent_count = 4;
    const auto c = static_cast<std::uint32_t>(vertices_.size());
    vertices_.push_back(centre);
    for (std::size_t k = 0; k < 4; ++k)
        add_child(parent, {v[k], m[k], c, m[(k + 3) % 4]}, outer(k, 0) | outer((k + 3) % 4, 3));
}

std::vector<std::uint32_t> RefinementTree::balance() {
    std::vector<std::uint32_t> done;
    const auto any = [](std::uint32_t) { return true; };
    if (elements_.size() == balanced_) return done;
    for (std::size_t before = done.size() + 1; before != done.size();) {
        before = done.size();
        for (std::uint32_t e = 0; e < elements_.size(); ++e)
            if (elements_[e].is_leaf() && is_cut_twice(elements_[e], any)) {
                split(e);
                done.push_back(e);
            }
    }
    balanced_ = elements_.size();
    return done;
}

}  // namespace patchlight
