#pragma once

#include "server/text_sink.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace patchlight::server {

/// Text on its way to a sink, in large pieces. For what is written number by number, a hundred
/// million times: room is made once for many small pieces, which are put there without a check
/// each.
class TextBuffer {
  public:
    explicit TextBuffer(TextSink sink);

    /// A place for at least `size` characters, of which end_at tells the last one used.
    char* room(std::size_t size) {
        if (text_.size() - used_ < size) make_room(size);
        return text_.data() + used_;
    }
    void end_at(const char* end) { used_ = static_cast<std::size_t>(end - text_.data()); }

    void append(std::string_view text);

    /// Characters taken so far.
    std::uint64_t size() const { return handed_on_ + used_; }

    /// Hands on what is left.
    void finish();

  private:
    void make_room(std::size_t size);

    TextSink sink_;
    std::string text_;
    std::size_t used_ = 0;
    std::uint64_t handed_on_ = 0;
};

}  // namespace patchlight::server
