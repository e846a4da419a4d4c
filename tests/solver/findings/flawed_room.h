#pragma once

#include "solver/settings.h"
#include "tests/solver/scenes.h"

#include <string>
#include <vector>

namespace patchlight {

/// Adds the polygon as an object of that name.
void add_named(Scene& scene, const std::string& name, const Polygon& polygon,
               MaterialIndex material = white);
/// A closed box of six polygons as one object.
void add_body(Scene& scene, const std::string& name, const Vec3& low, const Vec3& high,
              Facing facing = Facing::outwards, MaterialIndex material = white);

/// A closed room of 4 x 3 x 2.5 m: "floor", "ceiling", "west" (x = 0), "east", "south" (y = 0),
/// "north", and a "lamp" of 0.5 x 0.5 m, 0.1 m below the ceiling, that shines down. `without`: an
/// object that is left out.
Scene lit_room(const std::string& without = "");

/// The settings of a solve to an accuracy.
std::vector<Finding> told(const Scene& scene, const SolveSettings& settings = {});
/// The kinds of all findings, in order, each followed by a blank.
std::string kinds(const std::vector<Finding>& findings);

/// Where a finding says that it is: what stands in its detail as "(x, y, z) m".
Vec3 place_of(const Finding& finding);

/// Expects one finding, of that kind, which names these objects, is within `reach` of `place`, and
/// has a remedy.
void expect_told(const Scene& scene, const std::string& kind,
                 const std::vector<std::string>& objects, const Vec3& place, double reach,
                 const SolveSettings& settings = {});
void expect_nothing_told(const Scene& scene, const SolveSettings& settings = {});

}  // namespace patchlight
