#pragma once

#include "server/json_value.h"

#include <initializer_list>
#include <string>
#include <string_view>

namespace patchlight::server {

/// Why a feature that the contract names, but this version lacks, is refused: "`hemicube` is not
/// built yet; use `analytic` or `ray-cast`". Empty if the feature is there.
std::string why_not_built(std::string_view feature);

/// Throws InputError at the first of `keys` that `object` has and this version lacks.
void refuse_not_built(const JsonValue& object, std::initializer_list<const char*> keys);

}  // namespace patchlight::server
