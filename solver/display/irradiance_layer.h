#pragma once

#include "solver/display/closer_look.h"
#include "solver/scene/scene.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace patchlight {

/// One part of the irradiance, direct or indirect, on a tree: gathered at some vertices and linear
/// between them. It is refined by itself: the tree may be finer than it.
class IrradianceLayer {
  public:
    struct Gathered {
        Rgb value = Rgb::Zero();  // [W/m²]
        double variance = 0.0;    // of what is reflected of it, luminance; an estimate [W²/m⁴]
        bool known = false;       // else the work was stopped before it was gathered
    };
    /// Irradiance at vertices of the tree, in their order.
    using Gather = std::function<std::vector<Gathered>(std::span<const std::uint32_t> vertices)>;

    struct Rule {
        double target = 0.0;   // of the radiosity's error, √∫ Y² dA [W/m]
        double noise = 0.0;    // variance of one gathered value relative to its square [1]
        int most_levels = 10;  // below roots
        /// Elements that are cut whatever is found at their vertices.
        std::function<bool(const TreeElement&)> must_cut = [](const TreeElement&) { return false; };
        bool follow = false;  // look, too, where an element beside was cut twice as fine
        std::size_t most_vertices = 2'000'000;
        const CloserLook* closer = nullptr;  // where something was missed that vertices do not show
    };

    explicit IrradianceLayer(std::size_t vertices)
        : value_(vertices), variance_(vertices), known_(vertices) {}

    /// Gathers at the roots' corners, if that was not done yet, then cuts elements where linear
    /// interpolation misses what is gathered between, until the sum of what is expected to be
    /// missed yet is within the target, and it is nowhere far beyond. False if the work was
    /// stopped. `reflectance` of each patch weighs what is missed.
    bool refine(RefinementTree& tree, const std::vector<Rgb>& reflectance, const Rule& rule,
                const Gather& gather);

    /// More samples, `share` of all there will be then, at every vertex that is known. False if
    /// the work was stopped.
    bool join(const Gather& gather, double share);
    /// Shows the most likely field behind what was gathered (likely_field.h), until that changes.
    void smooth(const RefinementTree& tree, const std::vector<Rgb>& reflectance, double least_miss);
    /// The value at every vertex of the tree: interpolated where none was gathered.
    std::vector<Rgb> at_all(const RefinementTree& tree) const;
    /// Whether a split element of the tree is split in this layer.
    bool is_cut(const RefinementTree& tree, const TreeElement& element) const;
    bool known(std::uint32_t vertex) const { return vertex < known_.size() && known_[vertex]; }
    const std::vector<bool>& known() const { return known_; }
    /// Whether corners of roots were left out, for the work was stopped.
    bool lacks_roots() const { return lacks_roots_; }
    std::size_t gathered() const { return gathered_; }
    /// What is expected to be missed yet, √∫ Y² dA [W/m].
    double expected_miss() const { return expected_miss_; }
    /// What noise of gathering leaves in the field between vertices, before it is smoothed, √∫ Y²
    /// dA [W/m].
    double noise(const RefinementTree& tree) const;

  private:
    struct Leaf {  // of this layer
        std::uint32_t element = 0;
        double miss = 0.0;   // expected, squared and integrated [W²/m²]
        double sure = 0.0;   // the same, as far as noise can be no reason for it
        double doubt = 0.0;  // of `miss`, what noise may make it by chance
    };
    bool learn(const RefinementTree& tree, std::span<const std::uint32_t> elements,
               const Gather& gather);
    void grow(const RefinementTree& tree);
    double root_miss(const TreeElement& element, const Rgb& reflectance) const;
    void add_children(const RefinementTree& tree, std::uint32_t element, const Rgb& reflectance,
                      std::vector<Leaf>& leaves) const;
    void look_closer(const RefinementTree& tree, const CloserLook& closer);
    void follow_neighbours(const RefinementTree& tree, const Rule& rule,
                           std::vector<std::uint32_t>& marked, std::vector<Leaf>& kept) const;
    struct Miss {
        double square = 0.0, noise = 0.0;  // [W²/m⁴]
    };
    Miss miss(std::uint32_t vertex, const Rgb& expected, double noise,
              const Rgb& reflectance) const;

    std::vector<Rgb> value_;        // per vertex, as gathered [W/m²]
    std::vector<Rgb> likely_;       // the field behind it; or empty
    std::vector<double> variance_;  // per vertex [W²/m⁴]
    std::vector<bool> known_;       // per vertex: gathered
    std::vector<Leaf> leaves_;      // in the order of the tree's elements
    std::size_t gathered_ = 0;
    bool lacks_roots_ = false;
    double expected_miss_ = 0.0;
};

}  // namespace patchlight
