// SPDX-License-Identifier: BSD-3-Clause
#include "io/visual_materials.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <vector>

#include "text/numbers.hpp"

namespace swept::detail {

namespace {

using Element = XmlFile::Element;

std::string nameOf(const Element& material) {
  const char* const name = material.Attribute("name");
  return name == nullptr ? "" : name;
}

}  // namespace

VisualMaterials::VisualMaterials(XmlFile& xml, WarningKinds& warnings) : warnings_(warnings) {
  Element& robot = xml.robot();
  for (Element* material = robot.FirstChildElement("material"); material != nullptr;
       material = material->NextSiblingElement("material"))
    define(*material);
  for (Element* link = robot.FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link"))
    for (Element* visual = link->FirstChildElement("visual"); visual != nullptr;
         visual = visual->NextSiblingElement("visual"))
      if (const Element* material = visual->FirstChildElement("material")) define(*material);
}

void VisualMaterials::define(const Element& material) {
  if (nameOf(material).empty() || material.FirstChildElement() == nullptr) return;
  if (!named_.contains(nameOf(material))) named_.emplace(nameOf(material), ownColour(material));
}

std::optional<Colour> VisualMaterials::ownColour(const Element& material) {
  const Element* const element = material.FirstChildElement("color");
  if (element == nullptr) return std::nullopt;
  const char* const text = element->Attribute("rgba");
  const std::vector<double> parts = parseNumbers(text == nullptr ? "" : text);
  const bool isColour = parts.size() == 4 && std::ranges::all_of(parts, [](double part) {
                          return part >= 0.0 && part <= 1.0;
                        });
  if (isColour) return Colour{parts[0], parts[1], parts[2], parts[3]};
  warnings_.add(element->GetLineNum(),
                XmlFile::quote(*element, "rgba") + " of material '" + nameOf(material) +
                    "' must be 4 numbers from 0 to 1: it is shown without a colour",
                "# elements <color> have no 4 numbers from 0 to 1: they count as no colour");
  return std::nullopt;
}

std::optional<Colour> VisualMaterials::colourOf(Element& visual, const std::string& owner) {
  const Element* const material = visual.FirstChildElement("material");
  if (material == nullptr) return std::nullopt;
  const std::string name = nameOf(*material);
  if (name.empty()) return ownColour(*material);
  if (const auto known = named_.find(name); known != named_.end()) return known->second;
  warnings_.add(material->GetLineNum(),
                "material '" + name + "' of <visual> of " + owner +
                    " is not defined: it is shown without a colour",
                "# materials of <visual> are not defined: they count as no colour");
  return std::nullopt;
}

}  // namespace swept::detail
