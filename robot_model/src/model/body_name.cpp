// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/body_name.hpp"

#include <ostream>
#include <utility>

namespace swept {

BodyName::BodyName(std::string name)
    : name_(std::make_shared<const std::string>(std::move(name))) {}

const std::string& BodyName::str() const {
  static const std::string none;
  return name_ ? *name_ : none;
}

std::ostream& operator<<(std::ostream& out, const BodyName& name) {
  return out << name.str();
}

}  // namespace swept
