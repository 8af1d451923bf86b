// SPDX-License-Identifier: BSD-3-Clause
#include "io/collada_xml.hpp"

#include <charconv>

namespace swept::detail {

using tinyxml2::XMLElement;

void failElement(const InputSource& source, const XMLElement& element, const std::string& problem) {
  source.fail(element.GetLineNum(), std::string("<") + element.Name() + "> " + problem);
}

std::string colladaTarget(const XMLElement& element, const char* attribute) {
  const char* text = element.Attribute(attribute);
  return text != nullptr && text[0] == '#' ? text + 1 : "";
}

std::optional<std::uint64_t> colladaCount(std::string_view word) {
  std::uint32_t value = 0;
  const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
  if (result.ec != std::errc{} || result.ptr != word.data() + word.size()) return std::nullopt;
  return value;
}

std::uint64_t colladaCount(const InputSource& source, const XMLElement& element,
                           const char* attribute, std::optional<std::uint64_t> fallback) {
  const char* text = element.Attribute(attribute);
  if (text == nullptr && fallback) return *fallback;
  const auto value = colladaCount(text != nullptr ? text : "");
  if (!value)
    failElement(source, element, std::string("needs a whole number as '") + attribute + "'");
  return *value;
}

bool hasSemantic(const XMLElement& input, std::string_view semantic) {
  const char* const text = input.Attribute("semantic");
  return text != nullptr && text == semantic;
}

}  // namespace swept::detail
