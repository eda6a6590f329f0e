// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/markup_text.h"

#include <algorithm>

namespace frond {
namespace {

bool StartsCodePoint(char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }

// The bytes of the first `width` code points.
std::size_t PrefixBytes(std::string_view text, std::size_t width) {
  std::size_t bytes = 0;
  while (bytes < text.size()) {
    if (StartsCodePoint(text[bytes])) {
      if (width == 0) break;
      --width;
    }
    ++bytes;
  }
  return bytes;
}

}  // namespace

std::string EscapeXml(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '&':
        escaped += "&amp;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t' ? '?' : c;
    }
  }
  return escaped;
}

std::string EscapeMarkdown(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '<') {
      escaped += "&lt;";
    } else if (c == '&') {
      escaped += "&amp;";
    } else if (c == '\n') {
      escaped += ' ';
    } else {
      if (c == '\\' || c == '|' || c == '*' || c == '`' || c == '[' || c == ']') escaped += '\\';
      escaped += c;
    }
  }
  return escaped;
}

std::size_t TextWidth(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), StartsCodePoint));
}

std::string Shortened(std::string_view text, std::size_t width) {
  if (TextWidth(text) <= width) return std::string(text);
  return std::string(text.substr(0, PrefixBytes(text, width - 1))) + "…";
}

std::string Wrapped(std::string_view text, std::size_t width, std::size_t indent) {
  std::string wrapped, line;
  const auto end_line = [&] {
    wrapped += line + "\n";
    line = std::string(indent, ' ');
  };
  bool empty = true;
  while (!text.empty()) {
    std::size_t space = std::min(text.find(' '), text.size());
    if (text.substr(space).starts_with(" %")) space = std::min(text.find(' ', space + 1), text.size());
    std::string_view word = text.substr(0, space);
    text.remove_prefix(std::min(space + 1, text.size()));
    if (word.empty()) continue;
    if (!empty && TextWidth(line) + 1 + TextWidth(word) > width) {
      end_line();
      empty = true;
    }
    for (; TextWidth(line) + TextWidth(word) + (empty ? 0 : 1) > width; end_line()) {
      const std::size_t bytes = PrefixBytes(word, width - TextWidth(line));
      line += word.substr(0, bytes);
      word.remove_prefix(bytes);
    }
    line += (empty ? "" : " ") + std::string(word);
    empty = false;
  }
  if (!empty) end_line();
  return wrapped;
}

}  // namespace frond
