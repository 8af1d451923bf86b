// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tinyxml2.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "io/input_source.hpp"

namespace swept::detail {

/// Throws with the element's line and name in front of the problem.
[[noreturn]] void failElement(const InputSource& source, const tinyxml2::XMLElement& element,
                              const std::string& problem);

/// The id that `#id` in an attribute refers to; empty: it does not refer into the file.
std::string colladaTarget(const tinyxml2::XMLElement& element, const char* attribute);

/// The words of the element's text, which live as long as the document. Throws if it holds other
/// elements.
template <typename Action>
void forEachColladaWord(const tinyxml2::XMLElement& element, const InputSource& source,
                        const Action& action) {
  constexpr std::string_view kBlanks = " \t\r\n";
  for (const auto* node = element.FirstChild(); node != nullptr; node = node->NextSibling()) {
    if (node->ToComment() != nullptr) continue;
    if (node->ToText() == nullptr) failElement(source, element, "holds more than text");
    const std::string_view text = node->Value();
    for (auto at = text.find_first_not_of(kBlanks); at != std::string_view::npos;) {
      const auto end = std::min(text.find_first_of(kBlanks, at), text.size());
      action(text.substr(at, end - at));
      at = text.find_first_not_of(kBlanks, end);
    }
  }
}

/// Whole numbers below 2^32: sums and products of a few cannot overflow.
std::optional<std::uint64_t> colladaCount(std::string_view word);

/// The value of an attribute. Throws where it is missing, unless there is a fallback.
std::uint64_t colladaCount(const InputSource& source, const tinyxml2::XMLElement& element,
                           const char* attribute, std::optional<std::uint64_t> fallback = {});

bool hasSemantic(const tinyxml2::XMLElement& input, std::string_view semantic);

/// The children of that name, one after the other; null: all elements.
template <typename Element, typename Action>
void forEachChild(Element& parent, const char* name, const Action& action) {
  for (Element* child = parent.FirstChildElement(name); child != nullptr;
       child = child->NextSiblingElement(name)) {
    action(*child);
  }
}

}  // namespace swept::detail
