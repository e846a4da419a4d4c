#include "server/http/chunk_check.h"

#include <algorithm>
#include <optional>

namespace patchlight::server {
namespace {

constexpr std::size_t most_digits = 12;
constexpr std::size_t most_overhead = 8192;  // [bytes]

std::optional<std::size_t> hexadecimal(char byte) {
    if (byte >= '0' && byte <= '9') return static_cast<std::size_t>(byte - '0');
    if (byte >= 'a' && byte <= 'f') return static_cast<std::size_t>(byte - 'a' + 10);
    if (byte >= 'A' && byte <= 'F') return static_cast<std::size_t>(byte - 'A' + 10);
    return std::nullopt;
}

}  // namespace

bool ChunkCheck::accepts(std::string_view bytes) {
    while (!bytes.empty() && state_ != State::broken) {
        if (state_ == State::content) {
            const std::size_t taken = std::min(left_, bytes.size());
            left_ -= taken;
            bytes.remove_prefix(taken);
            if (left_ == 0) {
                state_ = State::end_of_content;
                digits_ = 0;
            }
            continue;
        }
        state_ = after(bytes.front());
        bytes.remove_prefix(1);
    }
    return state_ != State::broken;
}

ChunkCheck::State ChunkCheck::after(char byte) {
    switch (state_) {
        case State::size:
            return after_size(byte);
        case State::extension:
            if (byte == '\r') return State::end_of_size;
            return byte == '\n' || ++overhead_ > most_overhead ? State::broken : State::extension;
        case State::end_of_size:
            return byte == '\n' ? after_end_of_size() : State::broken;
        case State::end_of_content:
            if (byte != (saw_return_ ? '\n' : '\r')) return State::broken;
            saw_return_ = !saw_return_;
            return saw_return_ ? State::end_of_content : State::size;
        case State::line_of_trailer:
            if (byte == '\r') return State::end;
            [[fallthrough]];
        case State::trailer:
            if (byte == '\r') return State::end_of_trailer;
            return byte == '\n' || ++overhead_ > most_overhead ? State::broken : State::trailer;
        case State::end_of_trailer:
            return byte == '\n' ? State::line_of_trailer : State::broken;
        case State::end:
            return byte == '\n' ? State::complete : State::broken;
        case State::content:
        case State::complete:
        case State::broken:
            break;
    }
    return State::broken;
}

ChunkCheck::State ChunkCheck::after_size(char byte) {
    if (const auto digit = hexadecimal(byte)) {
        left_ = left_ * 16 + *digit;
        return ++digits_ > most_digits ? State::broken : State::size;
    }
    if (digits_ == 0) return State::broken;
    if (byte == '\r') return State::end_of_size;
    return byte == ';' || byte == ' ' || byte == '\t' ? State::extension : State::broken;
}

ChunkCheck::State ChunkCheck::after_end_of_size() const {
    return left_ == 0 ? State::line_of_trailer : State::content;
}

}  // namespace patchlight::server
