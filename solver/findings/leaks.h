#pragma once

#include "solver/findings/gaps.h"

#include <span>
#include <vector>

namespace patchlight {

/// A gap through which light gets out of a room that is closed but for such gaps, or into another
/// room.
struct Leak {
    Gap gap;
    bool leads_out = true;  // into the open or among backs, else into another room
    SurfaceIndex lit = 0;   // that is seen from the gap, within the room
};

/// Of the gaps, those that are leaks: from both ends light goes out through the gap and on for some
/// flights. Where most of it ends outside at one end and stays within at the other, or where what
/// it meets at one end does not see what it meets at the other, the gap parts two places. A slot
/// that ends blindly, such as that between a cupboard and a wall, does not.
std::vector<Leak> find_leaks(const FlawSearch& search, std::span<const Gap> gaps);

/// "light-leak": one for each pair of objects, with its widest gap.
std::vector<Finding> leak_findings(const FlawSearch& search, std::span<const Leak> leaks);

}  // namespace patchlight
