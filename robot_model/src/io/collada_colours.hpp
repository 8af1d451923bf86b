// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "io/collada_xml.hpp"

namespace swept::detail {

/// The diffuse colours of the materials of a COLLADA file. A colour that is not understood, or is a
/// texture, counts as none; nothing here refuses the file.
class ColladaColours {
 public:
  /// `root` outlives it.
  explicit ColladaColours(const tinyxml2::XMLElement& root);

  /// 0xRRGGBB, or kNoColour: of the faces that call their material by that name, where the
  /// <instance_geometry> shows them.
  std::uint32_t of(const tinyxml2::XMLElement& instance, const std::string& name) const;

 private:
  std::map<std::string, std::uint32_t> ofMaterial_;  ///< by id
};

}  // namespace swept::detail
