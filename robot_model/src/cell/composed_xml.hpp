// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tinyxml2.h>

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "swept/robot_model/work_cell.hpp"

namespace swept::detail {

/// An XML document made of elements of others, which knows where each came from.
class ComposedXml {
 public:
  using Element = tinyxml2::XMLElement;

  explicit ComposedXml(const std::string& robotName);
  /// A new child of the root.
  Element& add(const char* name, const LineOrigin& origin);
  Element& add(Element& parent, const char* name);
  /// A copy of another document's element, with all that is in it.
  Element& copy(const Element& element, const std::string& file);

  struct Text {
    std::string text;
    std::vector<LineOrigin> lines;
  };
  Text print() const;

 private:
  void note(const Element& copied, const Element& original, const std::string& file);
  tinyxml2::XMLDocument document_;
  Element* root_;
  std::map<const Element*, LineOrigin> origins_;
};

/// Puts `prefix` in front of the attribute's value, without the blanks around that; not if there is
/// none.
void prefixAttribute(tinyxml2::XMLElement& element, const char* attribute,
                     const std::string& prefix);

}  // namespace swept::detail
