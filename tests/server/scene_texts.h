#pragma once

#include "server/scene_json.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace patchlight::server {

/// A scene of one square metre of white floor at z = 0, facing up, with one block of it replaced:
/// scene_with("materials", R"({"white": {"reflectance": 2}})").
std::string scene_with(const std::string& block, const std::string& text);

/// The same with the object replaced: object 0, of material `white`, is all there is.
std::string scene_with_object(const std::string& text);

/// Expects InputError at `pointer` with `words` somewhere in its message.
void expect_rejected(std::string_view scene, const std::string& pointer,
                     const std::string& words = "");

}  // namespace patchlight::server
