#pragma once

#include "solver/scene/light.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace patchlight {

/// Something with a place and a direction it faces, such as a patch.
struct FacingPlace {
    Vec3 position = Vec3::Zero();  // [m]
    Vec3 normal = Vec3::UnitZ();   // unit
    double area = 0.0;             // that it stands for [m²]
};

/// Cuts places into parts that lie together and face alike: always the one in two whose light is
/// most likely to differ within, which grows with its area, its width and how much its normals
/// differ.
class AlikeParts {
  public:
    explicit AlikeParts(std::span<const FacingPlace> places);

    struct Part {
        double spread = 0.0;  // sum of area times the variance of the coordinates; 0: all alike
        std::size_t first = 0, end = 0;
        std::size_t widest = 0;  // coordinate
        double middle = 0.0;     // mean of that coordinate
        bool operator<(const Part& other) const {
            return spread != other.spread ? spread < other.spread : first > other.first;
        }
    };
    /// Into `most` parts, or fewer where there are fewer that differ; in the order of their places.
    std::vector<Part> cut(std::size_t most);
    /// In two that are not empty. The part has two places or more.
    std::array<Part, 2> halves(const Part& part);
    /// Numbers of the places of a part.
    std::span<std::uint32_t> places(const Part& part) {
        return std::span(order_).subspan(part.first, part.end - part.first);
    }
    std::span<const std::uint32_t> order() const { return order_; }

  private:
    /// The place over the size of all, then the normal, weighed.
    using Coordinates = std::array<double, 6>;
    Part measure(std::size_t first, std::size_t end) const;

    std::vector<Coordinates> at_;
    std::vector<double> area_;          // [m²]
    std::vector<std::uint32_t> order_;  // by parts
};

}  // namespace patchlight
