// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string_view>

#include "io/collada_xml.hpp"

namespace swept::detail {

/// Whether an element of that name places the node that it is in: translate, rotate, scale, matrix.
bool isColladaTransform(std::string_view name);

/// What such an element says; of others the identity. Fails unless assimp understands it likewise.
Eigen::Matrix4d colladaTransform(const tinyxml2::XMLElement& element, const InputSource& source);

}  // namespace swept::detail
