// SPDX-License-Identifier: BSD-3-Clause
#include "io/xml_places.hpp"

#include <algorithm>

namespace swept::detail {

namespace {

/// After the next `what`, or the end.
std::size_t after(std::string_view text, std::string_view what, std::size_t from) {
  const std::size_t at = text.find(what, from);
  return at == std::string_view::npos ? text.size() : at + what.size();
}

/// After the `>` of a tag; those within quotes do not count.
std::size_t afterTag(std::string_view text, std::size_t from) {
  char quote = 0;
  for (std::size_t i = from; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '>') {
      return i + 1;
    }
  }
  return text.size();
}

std::string_view nameAt(std::string_view text, std::size_t from) {
  const std::size_t end = std::min(text.size(), text.find_first_of(" \t\r\n/>", from));
  return text.substr(from, end - from);
}

}  // namespace

XmlPlaces placesOf(std::string_view text, std::string_view name) {
  XmlPlaces places;
  int depth = 0;  // elements that are open
  bool wanted = false;
  XmlPlaces::Range child;
  for (std::size_t at = text.find('<'); at < text.size(); at = text.find('<', at)) {
    const std::size_t begin = at;
    const std::string_view rest = text.substr(at);
    if (rest.starts_with("<!--")) {
      at = after(text, "-->", at + 4);
    } else if (rest.starts_with("<![CDATA[")) {
      at = after(text, "]]>", at);
    } else if (rest.starts_with("<?")) {
      at = after(text, "?>", at);
    } else if (rest.starts_with("<!")) {
      at = afterTag(text, at);
    } else if (rest.starts_with("</")) {
      at = afterTag(text, at);
      --depth;
      if (depth == 1 && wanted) places.elements.push_back({child.begin, at});
      if (depth == 0) places.rootEnd = {begin, at};
    } else {
      at = afterTag(text, at);
      const bool empty = at >= 2 && text[at - 2] == '/';
      if (depth == 0) {
        places.rootFound = true;
        places.rootIsEmpty = empty;
        places.rootEnd = {at - 1, at};
      }
      if (depth == 1) {
        wanted = nameAt(text, begin + 1) == name;
        child.begin = begin;
        if (wanted && empty) places.elements.push_back({begin, at});
      }
      if (!empty) ++depth;
    }
  }
  return places;
}

XmlPlaces::Range wholeLine(std::string_view text, XmlPlaces::Range range) {
  std::size_t begin = range.begin;
  while (begin > 0 && (text[begin - 1] == ' ' || text[begin - 1] == '\t')) --begin;
  if (begin > 0 && text[begin - 1] != '\n') return range;
  std::size_t end = range.end;
  while (end < text.size() && (text[end] == ' ' || text[end] == '\t' || text[end] == '\r')) ++end;
  if (end == text.size() || text[end] != '\n') return range;
  return {begin, end + 1};
}

}  // namespace swept::detail
