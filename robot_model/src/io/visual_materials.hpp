// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>

#include "io/warning_kinds.hpp"
#include "io/xml.hpp"
#include "swept/robot_model/visual_model.hpp"

namespace swept::detail {

/// The materials of a URDF: those of `<robot>`, and those that a `<visual>` gives a name, from the
/// first that has it. A colour that is none is left out, with a warning.
class VisualMaterials {
 public:
  VisualMaterials(XmlFile& xml, WarningKinds& warnings);

  /// None: there is no material, or it has no colour.
  std::optional<Colour> colourOf(XmlFile::Element& visual, const std::string& owner);

 private:
  void define(const XmlFile::Element& material);
  std::optional<Colour> ownColour(const XmlFile::Element& material);

  WarningKinds& warnings_;
  std::map<std::string, std::optional<Colour>> named_;
};

}  // namespace swept::detail
