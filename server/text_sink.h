#pragma once

#include <functional>
#include <string_view>

namespace patchlight::server {

/// Takes what is written, piece after piece: a file, standard output, a connection.
using TextSink = std::function<void(std::string_view)>;

}  // namespace patchlight::server
