// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/collada_xml.hpp"

namespace swept::detail {

/// The positions that the corners of a <mesh> of COLLADA are at: those of its <vertices>.
class ColladaPositions {
 public:
  /// Both outlive it.
  ColladaPositions(const tinyxml2::XMLElement& mesh, const InputSource& source)
      : mesh_(mesh), source_(source) {}

  /// For a mesh that has faces. Throws unless all numbers are there.
  void read();

  const std::vector<Eigen::Vector3d>& all() const { return all_; }
  /// Throws unless it names the <vertices>, if these were read.
  void requireNamed(const tinyxml2::XMLElement& input) const;

 private:
  /// How a <source> reads its array.
  struct Source {
    std::uint64_t count = 0, stride = 1, offset = 0;
    const tinyxml2::XMLElement* array = nullptr;
    bool hasXyz = false;  ///< its first three parameters
  };

  [[noreturn]] void fail(const tinyxml2::XMLElement& element, const std::string& problem) const {
    failElement(source_, element, problem);
  }
  const tinyxml2::XMLElement* arrayOf(const tinyxml2::XMLElement& source,
                                      const tinyxml2::XMLElement& accessor) const;
  Source readSource(const tinyxml2::XMLElement& source) const;
  void readPositions(const tinyxml2::XMLElement& input);
  void readVertices(const tinyxml2::XMLElement& vertices);

  const tinyxml2::XMLElement& mesh_;
  const InputSource& source_;
  bool isRead_ = false;
  std::multimap<std::string, const tinyxml2::XMLElement*> sources_;
  const tinyxml2::XMLElement* positions_ = nullptr;  ///< <source>
  const tinyxml2::XMLElement* vertices_ = nullptr;
  std::string verticesId_;
  std::vector<Eigen::Vector3d> all_;
};

}  // namespace swept::detail
