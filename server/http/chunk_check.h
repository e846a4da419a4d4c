#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace patchlight::server {

/// Follows a body in chunks as it goes by and sees where it leaves the grammar of RFC 9112 7.1,
/// which the library reads generously: a sign before a size, or bytes between two chunks.
class ChunkCheck {
  public:
    /// False from the first byte on that must not stand there.
    bool accepts(std::string_view bytes);

    bool is_complete() const { return state_ == State::complete; }

  private:
    enum class State : std::uint8_t {
        size,
        extension,
        end_of_size,
        content,
        end_of_content,
        line_of_trailer,
        trailer,
        end_of_trailer,
        end,
        complete,
        broken,
    };

    State after(char byte);
    State after_size(char byte);
    State after_end_of_size() const;

    State state_ = State::size;
    std::size_t left_ = 0;      // of the chunk [bytes]
    std::size_t digits_ = 0;    // of its size
    std::size_t overhead_ = 0;  // bytes of extensions and of the trailer
    bool saw_return_ = false;   // of the CR LF behind a chunk
};

}  // namespace patchlight::server
