// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace swept::detail {

/// Where elements stand in the text of an XML document, so that the rest can be kept byte for byte.
struct XmlPlaces {
  struct Range {
    std::size_t begin = 0;
    std::size_t end = 0;
  };
  std::vector<Range> elements;  ///< children of the root that have the name, in order
  bool rootFound = false;
  bool rootIsEmpty = false;  ///< `<robot/>`
  Range rootEnd;             ///< the root's end tag; of an empty root, its `>`
};

/// The text must be well-formed. Comments, CDATA and processing instructions are passed over.
XmlPlaces placesOf(std::string_view text, std::string_view name);

/// The range with the blanks before it and the end of the line after it, when nothing else is in
/// the line; else the range itself.
XmlPlaces::Range wholeLine(std::string_view text, XmlPlaces::Range range);

}  // namespace swept::detail
