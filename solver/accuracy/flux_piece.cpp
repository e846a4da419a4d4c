#include "solver/accuracy/flux_piece.h"

#include <algorithm>
#include <utility>

namespace patchlight {

void FluxPiece::weigh(double otherwise) {
    constexpr std::size_t enough = 8;
    double sum = 0.0, square = 0.0;
    for (const LandingShown& one : landed) {
        sum += static_cast<double>(one.y);
        square += static_cast<double>(one.y) * static_cast<double>(one.y);
    }
    typical = landed.size() >= enough ? square / sum : otherwise;
}

std::size_t FluxPiece::deciding() const {
    return static_cast<std::size_t>(std::count_if(
        landed.begin(), landed.end(), [](const LandingShown& one) { return one.decides; }));
}

FluxPiece FluxPiece::part(std::size_t k) const {
    const auto middle = [&](std::size_t a, std::size_t b) {
        return std::pair(Vec3(0.5 * (corners[a] + corners[b])), 0.5 * (shown[a] + shown[b]));
    };
    const std::array<std::pair<Vec3, double>, 3> middles{middle(0, 1), middle(1, 2), middle(2, 0)};
    FluxPiece piece;
    piece.area = 0.25 * area;
    for (std::size_t c = 0; c < 3; ++c) {
        const auto& [position, value] = k == 3               ? middles[c]
                                        : c == k             ? std::pair(corners[k], shown[k])
                                        : (c == (k + 1) % 3) ? middles[k]
                                                             : middles[(k + 2) % 3];
        piece.corners[c] = position;
        piece.shown[c] = value;
    }
    return piece;
}

std::array<FluxPiece, 4> cut(const FluxPiece& piece) {
    std::array<FluxPiece, 4> parts{piece.part(0), piece.part(1), piece.part(2), piece.part(3)};
    for (LandingShown one : piece.landed) {
        const std::array<float, 3> weight{1.0f - one.v - one.w, one.v, one.w};
        std::size_t k = 0;
        while (k < 3 && !(weight[k] > 0.5f)) ++k;
        std::array<float, 3> inside{};
        // In a corner's part the corner's weight is doubled less one; in the middle part, whose
        // corners lie opposite, each is one less twice the weight of the corner opposite.
        for (std::size_t c = 0; c < 3; ++c)
            inside[c] = k < 3 ? (c == k ? 2.0f * weight[c] - 1.0f : 2.0f * weight[c])
                              : 1.0f - 2.0f * weight[(c + 2) % 3];
        one.v = inside[1];
        one.w = inside[2];
        parts[k].landed.push_back(one);
    }
    return parts;
}

}  // namespace patchlight
