#include "solver/display/curved_mean.h"

namespace patchlight {

namespace {
constexpr double of_step = 0.25, of_value = 0.01;  // that a bend may reach [1]
}

Rgb bend(const VertexRow& row, const Rgb& from, const Rgb& to, std::span<const Rgb> values) {
    const Rgb second = values[row[0]] - 2.0 * values[row[1]] + values[row[2]];
    const Rgb most = of_step * (from - to).abs() + of_value * 0.5 * (from + to).abs();
    return (-second / 8.0).max(-most).min(most);
}

Rgb edge_mean(const std::optional<VertexRow>& row, std::uint32_t from, std::uint32_t to,
              std::span<const Rgb> values) {
    const Rgb mean = 0.5 * (values[from] + values[to]);
    return row ? Rgb(mean + bend(*row, values[from], values[to], values)) : mean;
}

Rgb curved_mean(const RefinementTree& tree, const TreeVertex& vertex, std::span<const Rgb> values) {
    const auto& of = vertex.parents;
    if (vertex.parent_count == 2) return edge_mean(vertex.row, of[0], of[1], values);
    Rgb middles = Rgb::Zero(), corners = Rgb::Zero();
    for (const std::uint32_t m : of) {
        middles += 0.5 * values[m];
        for (std::size_t end = 0; end < 2; ++end)
            corners += 0.125 * values[tree.vertices()[m].parents[end]];
    }
    return middles - corners;
}

double edge_noise(bool bent) {
    return bent ? 0.375 * 0.375 + 0.75 * 0.75 + 0.125 * 0.125 : 2.0 * 0.5 * 0.5;
}

// Out of the corners of a quad in the corner of the one it was cut out of, and of four beyond.
double quad_noise(bool bent) {
    return bent ? 0.125 * 0.125 + 2.0 * 0.3125 * 0.3125 + 0.5 * 0.5 + 4.0 * 0.0625 * 0.0625
                : 4.0 * 0.25 * 0.25;
}

}  // namespace patchlight
