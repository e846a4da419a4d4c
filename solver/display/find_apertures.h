#pragma once

#include "solver/display/aperture.h"
#include "solver/display/lamp_reach.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace patchlight {

/// Gaps through which sources light surfaces that send light back, where samples of the lamp would
/// hardly find it, or the spot it makes would fall between vertices. Lines through points beside
/// the edges of polygons are followed both ways: where one meets a source and on the other side a
/// front, and lines beside it are blocked on both sides, there is a gap. Gaps up to a hundredth of
/// the root of the area that lamps reach are looked for. Where some are found, more are looked for;
/// none where geometry far away takes more than one frame. `go_on` is asked now and then, from the
/// calling thread: after a false the search ends with what was found.
std::vector<Aperture> find_apertures(const Scene& scene, const RayScene& rays,
                                     const std::vector<LightSource>& sources,
                                     const LampReach& reach, std::uint64_t seed,
                                     const std::function<bool()>& go_on = {});

}  // namespace patchlight
