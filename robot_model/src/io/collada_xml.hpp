// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tinyxml2.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/input_source.hpp"

namespace swept::detail {

/// With the element's line and name ahead of the problem.
[[noreturn]] void failElement(const InputSource& source, const tinyxml2::XMLElement& element,
                              const std::string& problem);

/// What `#id` in an attribute points to; empty: it does not point into the file.
std::string colladaTarget(const tinyxml2::XMLElement& element, const char* attribute);

/// The words of its text, which live as long as that. Fails if it holds other elements.
std::vector<std::string_view> colladaWords(const tinyxml2::XMLElement& element,
                                           const InputSource& source);

/// Whole numbers below 2^32: sums and products of a few cannot overflow.
std::optional<std::uint64_t> colladaCount(std::string_view word);

/// That of an attribute. Fails where there is none, unless there is one to fall back on.
std::uint64_t colladaCount(const InputSource& source, const tinyxml2::XMLElement& element,
                           const char* attribute, std::optional<std::uint64_t> fallback = {});

bool hasSemantic(const tinyxml2::XMLElement& input, std::string_view semantic);

/// Makes the words all that the element has: assimp stops at a comment between them.
void setColladaWords(tinyxml2::XMLElement& element, const std::vector<std::string_view>& words);

/// The children of that name, one after the other; null: all elements.
template <typename Element, typename Action>
void forEachChild(Element& parent, const char* name, const Action& action) {
  for (Element* child = parent.FirstChildElement(name); child != nullptr;
       child = child->NextSiblingElement(name)) {
    action(*child);
  }
}

/// Deletes all children, text and comments too, but the elements of which `isKept` is true.
template <typename Predicate>
void keepChildren(tinyxml2::XMLNode& parent, const Predicate& isKept) {
  for (tinyxml2::XMLNode* child = parent.FirstChild(); child != nullptr;) {
    tinyxml2::XMLNode* const next = child->NextSibling();
    tinyxml2::XMLElement* const element = child->ToElement();
    if (element == nullptr || !isKept(*element)) parent.DeleteChild(child);
    child = next;
  }
}

}  // namespace swept::detail
