#pragma once

#include "server/http/problem.h"
#include "solver/scene/input_error.h"

namespace patchlight::server {

/// What is wrong with a scene: 400 if its bytes are no JSON, with the offset of the culprit, else
/// 422 with its pointer.
Problem problem_of(const InputError& error);

}  // namespace patchlight::server
