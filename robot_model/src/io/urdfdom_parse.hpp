// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <urdf_model/model.h>
#include <urdf_world/types.h>

#include <string>

#include "io/input_source.hpp"

namespace swept::detail {

/// urdfdom's model of `text`. Nothing is printed: what urdfdom has to say becomes the message of
/// the InputError when it refuses the text.
urdf::ModelInterfaceSharedPtr parseWithUrdfdom(const std::string& text, const InputSource& source);

}  // namespace swept::detail
