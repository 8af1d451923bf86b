// SPDX-License-Identifier: BSD-3-Clause
#include "io/collada_xml.hpp"

#include <algorithm>
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

std::vector<std::string_view> colladaWords(const XMLElement& element, const InputSource& source) {
  constexpr std::string_view kSpace = " \t\r\n";
  std::vector<std::string_view> found;
  for (const auto* node = element.FirstChild(); node != nullptr; node = node->NextSibling()) {
    if (node->ToComment() != nullptr) continue;
    if (node->ToText() == nullptr) failElement(source, element, "holds more than text");
    const std::string_view text = node->Value();
    for (auto at = text.find_first_not_of(kSpace); at != std::string_view::npos;) {
      const auto end = std::min(text.find_first_of(kSpace, at), text.size());
      found.push_back(text.substr(at, end - at));
      at = text.find_first_not_of(kSpace, end);
    }
  }
  return found;
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

void setColladaWords(XMLElement& element, const std::vector<std::string_view>& words) {
  std::string text;
  for (const std::string_view word : words) {
    if (!text.empty()) text += ' ';
    text += word;
  }
  element.DeleteChildren();
  element.SetText(text.c_str());
}

}  // namespace swept::detail
