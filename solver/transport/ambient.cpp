#include "solver/transport/ambient.h"

namespace patchlight {

Field ambient_irradiance(const AmbientScene& scene, const Field& unshot) {
    Field ambient(unshot.size());
    const std::vector<double>& s = scene.front_share;
    for (std::size_t c = 0; c < unshot.size(); ++c) {
        double seen = 0.0, arriving = 0.0, returned = 0.0;
        for (std::size_t i = 0; i < s.size(); ++i) {
            const double seen_area = scene.area[i] * s[i];
            seen += seen_area;
            arriving += seen_area * unshot[c][i];
            returned += seen_area * s[i] * scene.reflectance[c][i];
        }
        // ρ < 1 and s <= 1, so light dies out: returned < seen.
        const double surroundings = seen > 0.0 ? arriving / (seen - returned) : 0.0;
        ambient[c].resize(s.size());
        for (std::size_t i = 0; i < s.size(); ++i) ambient[c][i] = s[i] * surroundings;
    }
    return ambient;
}

}  // namespace patchlight
