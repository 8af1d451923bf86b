// SPDX-License-Identifier: BSD-3-Clause
#include "output/unchecked_json.hpp"

namespace swept {

void addUnchecked(Json& json, const Checker& checker, const std::vector<std::string>& warnings) {
  json["nothing_checked"] = checker.checksNothing();
  json["links_without_geometry"] = checker.linksWithoutGeometry();
  json["warnings"] = warnings;
}

}  // namespace swept
