#include "server/text_buffer.h"

#include <algorithm>
#include <utility>

namespace patchlight::server {

TextBuffer::TextBuffer(TextSink sink) : sink_(std::move(sink)), text_(std::size_t{1} << 18, '\0') {}

void TextBuffer::append(std::string_view text) {
    end_at(std::copy(text.begin(), text.end(), room(text.size())));
}

void TextBuffer::finish() {
    sink_(std::string_view(text_).substr(0, used_));
    handed_on_ += used_;
    used_ = 0;
}

void TextBuffer::make_room(std::size_t size) {
    finish();
    if (text_.size() < size) text_.resize(size);
}

}  // namespace patchlight::server
