#pragma once

#include "solver/scene/local_tolerance.h"
#include "solver/scene/scene.h"

#include <functional>

namespace patchlight {

/// Calls visit(a, b), a < b, for surfaces whose boxes, widened by their tolerances, intersect:
/// found in a tree of boxes, in parallel. All calls with one `a` come from one thread. `go_on` is
/// asked now and then, from the calling thread; after a false no more are visited.
void for_each_touching_pair(const Scene& scene, const LocalTolerance& tolerance,
                            const std::function<bool()>& go_on,
                            const std::function<void(SurfaceIndex, SurfaceIndex)>& visit);

/// Calls visit(k) for each of `count` places, in parallel, some at a time; `go_on` as above.
void for_each_in_parallel(std::size_t count, const std::function<bool()>& go_on,
                          const std::function<void(std::size_t)>& visit);

}  // namespace patchlight
