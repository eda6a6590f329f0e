// SPDX-License-Identifier: BSD-3-Clause
// Text for people: escaped, measured, shortened and wrapped. All texts are UTF-8; a width counts code points.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace frond {

// For the text and the attributes of HTML, XML and SVG: < > & " ' as entities, control characters as '?'.
std::string EscapeXml(std::string_view text);

// For a paragraph or table cell of Markdown: nothing of `text` is markup, HTML or the end of the cell.
std::string EscapeMarkdown(std::string_view text);

std::size_t TextWidth(std::string_view text);

// At most `width` wide, with "…" at its end where something was left out. `width` is at least 1.
std::string Shortened(std::string_view text, std::size_t width);

// In lines of at most `width`, broken at spaces but for that of "5 %" (within a word that is wider), each
// ended by '\n'; all but the first start with `indent` spaces.
std::string Wrapped(std::string_view text, std::size_t width, std::size_t indent = 0);

}  // namespace frond
