#pragma once

#include "solver/display/aperture.h"
#include "solver/display/light_sources.h"

#include <cstdint>
#include <vector>

namespace patchlight {

/// Gaps through which sources light surfaces that send light back, where samples of the lamp would
/// hardly find it, or the spot it makes would fall between vertices. Lines through points beside
/// the edges of polygons are followed both ways: where one meets a source and on the other side a
/// front, and lines beside it are blocked on both sides, there is a gap. `area`: of what is
/// lit [m²]; gaps up to a hundredth of its root are looked for. Where some are found, more
/// are looked for; none where geometry far away takes more than one frame.
std::vector<Aperture> find_apertures(const Scene& scene, const RayScene& rays,
                                     const std::vector<LightSource>& sources, double area,
                                     std::uint64_t seed);

}  // namespace patchlight
