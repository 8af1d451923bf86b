// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace swept::detail {

/// Connectivity of triangles: which share a vertex or an edge, by index.
///
/// Two triangles with a common vertex always touch, so only pairs without one are tested against
/// each other. A vertex and a face, or two edges, without a common vertex are covered if they
/// belong to two triangles that have no common vertex either. Otherwise they are orphans (Tang,
/// Curtis, Yoon, Manocha 2009, "ICCD", section 4) and need their own test. A usual closed surface
/// has none.
class SurfaceFeatures {
 public:
  SurfaceFeatures(std::size_t vertices, std::span<const Eigen::Vector3i> triangles);

  const std::vector<Eigen::Vector3i>& triangles() const { return triangles_; }
  const Eigen::Vector3i& triangle(int t) const { return triangles_[static_cast<std::size_t>(t)]; }
  /// Per triangle: its connected piece, from 0.
  const std::vector<int>& pieces() const { return pieces_; }
  /// Per triangle: not 0 if it may have an orphan. All triangles of an orphan's features have.
  const std::vector<std::uint8_t>& marks() const { return marks_; }

  /// In ascending order.
  std::span<const int> around(int vertex) const;
  /// Number of the edge between corners k and k + 1.
  int edge(int triangle, int k) const {
    return edges_[static_cast<std::size_t>(triangle)][static_cast<std::size_t>(k)];
  }
  /// Triangles with this edge, in ascending order.
  std::span<const int> beside(int edge) const;

  /// For a vertex that is not one of the face's.
  bool isOrphan(int vertex, int face) const;
  /// For edges without a common vertex.
  bool areOrphans(int edge, int other) const;

 private:
  void findPieces(std::size_t vertices);
  void numberEdges();
  void markOrphans(std::size_t vertices);
  int leastBusy(std::span<const int> triangles) const;
  std::size_t neighbours(int triangle) const;

  std::vector<Eigen::Vector3i> triangles_;
  std::vector<int> pieces_;
  std::vector<std::uint8_t> marks_;
  std::vector<int> aroundFirst_, around_;
  std::vector<std::array<int, 3>> edges_;
  std::vector<int> besideFirst_, beside_;
};

}  // namespace swept::detail
