#pragma once

#include <string>
#include <string_view>

namespace patchlight::server {

/// A text as it stands in HTML, between tags or in an attribute's double quotes.
std::string html_text(std::string_view text);

/// <figure> of a picture with what is said below it, both ready as HTML.
std::string html_figure(const std::string& file, const std::string& alternative,
                        const std::string& caption);

}  // namespace patchlight::server
