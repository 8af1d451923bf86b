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
  ColladaPositions(tinyxml2::XMLElement& mesh, const InputSource& source)
      : mesh_(mesh), source_(source) {}

  /// For a mesh that has faces. Fails unless all numbers are there. What is left of the elements is
  /// what the positions need.
  void read();

  const std::vector<Eigen::Vector3d>& all() const { return all_; }
  /// What reading them in single precision changes at most.
  double loss() const { return loss_; }
  /// Fails unless it names the <vertices>, if these were read.
  void requireNamed(const tinyxml2::XMLElement& input) const;
  /// Whether the child of the mesh is one that was read.
  bool isPart(const tinyxml2::XMLElement& child) const {
    return &child == vertices_ || &child == positions_;
  }
  /// These ahead of all others.
  void moveToFront();

 private:
  /// How a <source> reads its array.
  struct Source {
    std::uint64_t count = 0, stride = 1, offset = 0;
    tinyxml2::XMLElement* array = nullptr;
    tinyxml2::XMLElement* accessor = nullptr;
    bool hasXyz = false;  ///< its first three parameters
  };

  [[noreturn]] void fail(const tinyxml2::XMLElement& element, const std::string& problem) const {
    failElement(source_, element, problem);
  }
  std::vector<std::string_view> words(const tinyxml2::XMLElement& element) const {
    return colladaWords(element, source_);
  }
  tinyxml2::XMLElement* arrayOf(tinyxml2::XMLElement& source,
                                const tinyxml2::XMLElement& accessor) const;
  Source readSource(tinyxml2::XMLElement& source) const;
  void readPositions(tinyxml2::XMLElement& input);
  void keepPositions(const Source& source, const std::vector<std::string_view>& words);
  void readVertices(tinyxml2::XMLElement& vertices);

  tinyxml2::XMLElement& mesh_;
  const InputSource& source_;
  bool isRead_ = false;
  std::multimap<std::string, tinyxml2::XMLElement*> sources_;
  tinyxml2::XMLElement* positions_ = nullptr;  ///< <source>
  tinyxml2::XMLElement* vertices_ = nullptr;
  std::string verticesId_;
  std::vector<Eigen::Vector3d> all_;
  double loss_ = 0.0;
};

}  // namespace swept::detail
