// SPDX-License-Identifier: BSD-3-Clause
#include "io/collada_check.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/mesh_file.hpp"

namespace swept::detail {

namespace {

using tinyxml2::XMLElement;
using Count = std::uint64_t;
constexpr std::string_view kSpace = " \t\r\n";

[[noreturn]] void fail(const XMLElement& element, const std::string& problem) {
  throw MeshFileError("cannot be read: its line " + std::to_string(element.GetLineNum()) + ": <" +
                      element.Name() + "> " + problem);
}

std::vector<std::string_view> words(const XMLElement& element) {
  std::vector<std::string_view> found;
  for (const auto* node = element.FirstChild(); node != nullptr; node = node->NextSibling()) {
    if (node->ToComment() != nullptr) continue;
    if (node->ToText() == nullptr) fail(element, "holds more than text");
    const std::string_view text = node->Value();
    for (auto at = text.find_first_not_of(kSpace); at != std::string_view::npos;) {
      const auto end = std::min(text.find_first_of(kSpace, at), text.size());
      found.push_back(text.substr(at, end - at));
      at = text.find_first_not_of(kSpace, end);
    }
  }
  return found;
}

/// Whole numbers below 2^32: sums and products of a few cannot overflow.
std::optional<Count> wholeNumber(std::string_view word) {
  std::uint32_t value = 0;
  const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
  if (result.ec != std::errc{} || result.ptr != word.data() + word.size()) return std::nullopt;
  return value;
}

Count attribute(const XMLElement& element, const char* name, std::optional<Count> fallback = {}) {
  const char* text = element.Attribute(name);
  if (text == nullptr && fallback) return *fallback;
  const auto value = wholeNumber(text != nullptr ? text : "");
  if (!value) fail(element, std::string("needs a whole number as '") + name + "'");
  return *value;
}

/// What `#id` in an attribute points to.
std::string target(const XMLElement& element) {
  const char* text = element.Attribute("source");
  return text != nullptr && text[0] == '#' ? text + 1 : "";
}

/// One <mesh>: every name in it is looked up in it, as assimp does.
class MeshChecker {
 public:
  void check(const XMLElement& mesh);

 private:
  void readSource(const XMLElement& source);
  Count sizeOf(const XMLElement& input) const;
  void checkPrimitives(const XMLElement& primitives) const;

  std::map<std::string, Count> sizes_;  ///< entries of each <source> and <vertices>
};

void MeshChecker::readSource(const XMLElement& source) {
  std::map<std::string, Count> arrays;
  for (const XMLElement* array = source.FirstChildElement("float_array"); array != nullptr;
       array = array->NextSiblingElement("float_array")) {
    const Count count = attribute(*array, "count");
    if (words(*array).size() != count) fail(*array, "does not hold as many numbers as its count");
    if (const char* id = array->Attribute("id")) arrays[id] = count;
  }
  const XMLElement* technique = source.FirstChildElement("technique_common");
  const XMLElement* accessor = technique ? technique->FirstChildElement("accessor") : nullptr;
  const char* id = source.Attribute("id");
  if (accessor == nullptr || id == nullptr) return;
  const Count count = attribute(*accessor, "count");
  const Count stride = attribute(*accessor, "stride", 1);
  const Count offset = attribute(*accessor, "offset", 0);
  Count parameters = 0;
  for (const XMLElement* p = accessor->FirstChildElement("param"); p != nullptr;
       p = p->NextSiblingElement("param")) {
    ++parameters;
  }
  const auto array = arrays.find(target(*accessor));
  if (array == arrays.end() || parameters > stride || offset > array->second ||
      (stride != 0 && count > (array->second - offset) / stride)) {
    fail(*accessor, "reaches beyond its array");
  }
  sizes_[id] = count;
}

Count MeshChecker::sizeOf(const XMLElement& input) const {
  const auto found = sizes_.find(target(input));
  if (found == sizes_.end()) fail(input, "names a source that does not exist");
  return found->second;
}

void MeshChecker::checkPrimitives(const XMLElement& primitives) const {
  constexpr Count kMaxOffset = 64;  // far beyond the handful of inputs that files have
  std::vector<Count> limits;
  for (const XMLElement* input = primitives.FirstChildElement("input"); input != nullptr;
       input = input->NextSiblingElement("input")) {
    const Count offset = attribute(*input, "offset", 0);
    if (offset > kMaxOffset) fail(*input, "has an offset beyond every input");
    if (limits.size() <= offset) limits.resize(offset + 1, std::numeric_limits<Count>::max());
    limits[offset] = std::min(limits[offset], sizeOf(*input));
  }
  for (const char* name : {"p", "vcount"}) {
    const bool indices = name[0] == 'p';
    for (const XMLElement* list = primitives.FirstChildElement(name); list != nullptr;
         list = list->NextSiblingElement(name)) {
      const auto entries = words(*list);
      if (indices && limits.empty() && !entries.empty()) fail(*list, "has no <input> to index");
      for (std::size_t i = 0; i < entries.size(); ++i) {
        const auto value = wholeNumber(entries[i]);
        if (!value) fail(*list, "does not hold whole numbers only");
        if (indices && *value >= limits[i % limits.size()])
          fail(*list, "has an index past its source");
      }
    }
  }
}

void MeshChecker::check(const XMLElement& mesh) {
  for (const XMLElement* e = mesh.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
    if (std::string_view(e->Name()) == "source") readSource(*e);
  }
  for (const XMLElement* e = mesh.FirstChildElement("vertices"); e != nullptr;
       e = e->NextSiblingElement("vertices")) {
    Count size = std::numeric_limits<Count>::max();
    for (const XMLElement* input = e->FirstChildElement("input"); input != nullptr;
         input = input->NextSiblingElement("input")) {
      size = std::min(size, sizeOf(*input));
    }
    if (const char* id = e->Attribute("id")) sizes_[id] = size;
  }
  for (const XMLElement* e = mesh.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
    const std::string_view name = e->Name();
    if (name != "source" && name != "vertices" && name != "extra") checkPrimitives(*e);
  }
}

/// Checks every <mesh>, wherever it stands.
class MeshFinder final : public tinyxml2::XMLVisitor {
 public:
  bool VisitEnter(const XMLElement& element, const tinyxml2::XMLAttribute*) override {
    if (std::string_view(element.Name()) != "mesh") return true;
    MeshChecker().check(element);
    return false;
  }
};

}  // namespace

void checkCollada(std::string_view text) {
  tinyxml2::XMLDocument document;
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    throw MeshFileError("cannot be read: its line " + std::to_string(document.ErrorLineNum()) +
                        " is malformed XML");
  }
  MeshFinder finder;
  document.Accept(&finder);
}

}  // namespace swept::detail
