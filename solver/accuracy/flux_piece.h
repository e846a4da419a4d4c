#pragma once

#include "solver/scene/scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace patchlight {

/// A landing in the display.
struct LandingShown {
    std::uint32_t triangle = 0;
    std::uint32_t path = 0;
    float v = 0.0f, w = 0.0f;  // weights of the second and the third corner
    float y = 0.0f;            // Y(ρ Φ) [W]
    bool straight = false;
    bool decides = false;  // where regions are
};

/// A triangle, or a part of one, with what landed there.
struct FluxPiece {
    std::array<Vec3, 3> corners;
    std::array<double, 3> shown{};  // Y(ρ H̃) at them [W/m²]
    double area = 0.0;
    std::vector<LandingShown> landed;  // weights are those of this piece
    double typical = 0.0;              // flux of a landing, weighted with itself [W]

    /// From its own landings, if they are enough to tell.
    void weigh(double otherwise);
    std::size_t deciding() const;
    /// Number k of four: at corner k, or in the middle.
    FluxPiece part(std::size_t k) const;
};

/// The four parts of a piece; landings go with them.
std::array<FluxPiece, 4> cut(const FluxPiece& piece);

}  // namespace patchlight
