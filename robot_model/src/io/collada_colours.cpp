// SPDX-License-Identifier: BSD-3-Clause
#include "io/collada_colours.hpp"

#include <cmath>
#include <string_view>
#include <vector>

#include "io/mesh_content.hpp"
#include "text/numbers.hpp"

namespace swept::detail {

namespace {

using tinyxml2::XMLElement;

/// The first element down from `element` by these names; null: there is none.
const XMLElement* below(const XMLElement* element, std::initializer_list<const char*> names) {
  for (const char* const name : names) {
    if (element == nullptr) return nullptr;
    element = element->FirstChildElement(name);
  }
  return element;
}

std::string attributeOf(const XMLElement& element, const char* name) {
  const char* const text = element.Attribute(name);
  return text != nullptr ? text : "";
}

std::uint32_t colourOf(const XMLElement& effect) {
  const XMLElement* const technique = below(&effect, {"profile_COMMON", "technique"});
  if (technique == nullptr) return kNoColour;
  for (const char* const shader : {"phong", "lambert", "blinn"}) {
    const XMLElement* const colour = below(technique, {shader, "diffuse", "color"});
    if (colour == nullptr) continue;
    const char* const text = colour->GetText();
    const std::vector<double> parts = parseNumbers(text != nullptr ? text : "");
    if (parts.size() != 3 && parts.size() != 4) return kNoColour;
    std::uint32_t code = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      if (!(parts[i] >= 0.0 && parts[i] <= 1.0)) return kNoColour;
      code = code << 8 | static_cast<std::uint32_t>(std::lround(255.0 * parts[i]));
    }
    return code;
  }
  return kNoColour;
}

}  // namespace

ColladaColours::ColladaColours(const XMLElement& root) {
  std::map<std::string, std::uint32_t> ofEffect;
  forEachChild(root, "library_effects", [&](const XMLElement& effects) {
    forEachChild(effects, "effect", [&](const XMLElement& effect) {
      ofEffect.emplace(attributeOf(effect, "id"), colourOf(effect));
    });
  });
  forEachChild(root, "library_materials", [&](const XMLElement& materials) {
    forEachChild(materials, "material", [&](const XMLElement& material) {
      const XMLElement* const effect = material.FirstChildElement("instance_effect");
      if (effect == nullptr) return;
      const auto known = ofEffect.find(colladaTarget(*effect, "url"));
      if (known != ofEffect.end()) ofMaterial_.emplace(attributeOf(material, "id"), known->second);
    });
  });
}

std::uint32_t ColladaColours::of(const XMLElement& instance, const std::string& name) const {
  const XMLElement* const bound = below(&instance, {"bind_material", "technique_common"});
  if (bound == nullptr) return kNoColour;
  std::uint32_t colour = kNoColour;
  forEachChild(*bound, "instance_material", [&](const XMLElement& material) {
    if (attributeOf(material, "symbol") != name) return;
    const auto known = ofMaterial_.find(colladaTarget(material, "target"));
    if (known != ofMaterial_.end()) colour = known->second;
  });
  return colour;
}

}  // namespace swept::detail
