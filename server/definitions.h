#pragma once

#include "server/json_value.h"

#include <optional>
#include <string>
#include <vector>

namespace patchlight::server {

/// The block `definitions` of a scene: bodies of objects by name, for `instance` to put in place.
class Definitions {
  public:
    /// `scene` is the whole document and has to outlive it. Throws InputError if the block is no
    /// object.
    explicit Definitions(const JsonValue& scene) : block_(scene.find("definitions")) {
        if (block_) block_->require_map();
    }

    std::vector<std::string> names() const {
        std::vector<std::string> all;
        if (block_)
            block_->for_each_member(
                [&](const std::string& name, const JsonValue&) { all.push_back(name); });
        return all;
    }

    /// The one that `instance` names. Throws InputError if there is none.
    JsonValue body(const JsonValue& instance) const;

    /// The one of a name that is known to be there. `name` has to outlive it.
    JsonValue body(const std::string& name) const { return block_->at(name); }

  private:
    std::optional<JsonValue> block_;
};

}  // namespace patchlight::server
