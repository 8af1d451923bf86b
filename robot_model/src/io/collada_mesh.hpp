// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/input_source.hpp"

namespace tinyxml2 {
class XMLElement;
}  // namespace tinyxml2

namespace swept::detail {

/// The faces of a <mesh> of COLLADA.
struct ColladaMesh {
  std::uint64_t triangles = 0;           ///< a polygon of n corners counts n - 2
  int groups = 0;                        ///< elements that have faces
  std::vector<Eigen::Vector3d> corners;  ///< of all faces, each vertex once; the mesh's unit
  double loss = 0.0;                     ///< at most, of a coordinate in single precision
};

/// Fails unless all that the mesh's elements name and count is there, in the forms that assimp
/// understands: it does not look before it follows them.
ColladaMesh readColladaMesh(const tinyxml2::XMLElement& mesh, const InputSource& source);

/// With the element's line and name ahead of the problem.
[[noreturn]] void failElement(const InputSource& source, const tinyxml2::XMLElement& element,
                              const std::string& problem);

/// What `#id` in an attribute points to; empty: it does not point into the file.
std::string colladaTarget(const tinyxml2::XMLElement& element, const char* attribute);

/// The words of its text. Fails if it holds other elements.
std::vector<std::string_view> colladaWords(const tinyxml2::XMLElement& element,
                                           const InputSource& source);

}  // namespace swept::detail
