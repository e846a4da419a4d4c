#pragma once

#include <cstdint>
#include <vector>

namespace patchlight {

/// The vertex in the middle of each edge that was cut. An edge is listed at the younger of its
/// ends: those cut out of it later have younger ends, so that the lists stay short.
class EdgeMiddles {
  public:
    static constexpr std::uint32_t none = ~0u;

    struct Edge {
        std::uint32_t a = 0, b = 0;  // a < b: numbers of its ends, younger ones are higher
        std::uint32_t owner = 0;     // edges between the same ends with other owners are others
    };

    std::uint32_t find(const Edge& edge) const {
        if (edge.b >= newest_.size()) return none;
        for (std::uint32_t n = newest_[edge.b]; n != none; n = cuts_[n].before)
            if (cuts_[n].a == edge.a && cuts_[n].owner == edge.owner) return cuts_[n].middle;
        return none;
    }

    /// Of an edge that has none yet.
    void add(const Edge& edge, std::uint32_t middle) {
        if (edge.b >= newest_.size()) newest_.resize(edge.b + 1, none);
        cuts_.push_back({edge.a, edge.owner, middle, newest_[edge.b]});
        newest_[edge.b] = static_cast<std::uint32_t>(cuts_.size() - 1);
    }

  private:
    struct Cut {
        std::uint32_t a, owner, middle;
        std::uint32_t before;  // of the same younger end; or none
    };
    std::vector<std::uint32_t> newest_;  // per vertex: number of a cut, or none
    std::vector<Cut> cuts_;
};

}  // namespace patchlight
