// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace swept::detail {

/// The space that an open mesh surrounds, at the resolution of a grid: cells that no path from the
/// outside through cells without triangles reaches. Collision meshes of links are often shells with
/// slits and parts inside, and a large ball serves them as well as it does a solid. It guides the
/// placement of balls; no proof depends on it.
class Pockets {
 public:
  Pockets(std::span<const Eigen::Vector3d> vertices, std::span<const Eigen::Vector3i> triangles);
  bool areNone() const { return areNone_; }
  /// Whether some part of the triangle borders on the outside; other triangles are within.
  bool isSkin(int triangle) const { return isSkin_[triangle]; }
  /// These triangles, or the parts of them that border on the outside if other parts are within.
  const std::vector<Eigen::Vector3d>& skinVertices() const { return skinVertices_; }  ///< m
  const std::vector<Eigen::Vector3i>& skinTriangles() const { return skinTriangles_; }
  /// False if contain() is false at any distance.
  bool mayContain(const Eigen::Vector3d& p) const { return kindAt(p) != Kind::Outside; }
  /// Whether a point is within; `toSkin`: m, its distance from the nearest triangle of the skin.
  bool contain(const Eigen::Vector3d& p, double toSkin) const;

 private:
  using Index = std::array<int, 3>;
  /// Within and Skin cells are occupied, and known not to touch, or to touch, the outside.
  enum class Kind : std::uint8_t { Unreached, Occupied, Within, Skin, Outside };
  /// The part of a triangle in a cell.
  struct Part {
    Index cell;
    int triangle;
    std::vector<Eigen::Vector3d>::size_type first;  ///< of its corners
    int count;                                      ///< 0: the whole triangle
  };
  struct Parts {
    std::vector<Part> list;  ///< by triangle
    std::vector<Eigen::Vector3d> corners;
  };

  Parts partsOf(std::span<const Eigen::Vector3d> vertices,
                std::span<const Eigen::Vector3i> triangles) const;
  void divide(std::span<const Eigen::Vector3d> polygon, const Index& first, const Index& last,
              int triangle, Parts& parts) const;
  void walkFromOutside();
  void peel(const Parts& parts, std::span<const Eigen::Vector3d> vertices,
            std::span<const Eigen::Vector3i> triangles);
  bool touchesOutside(const Index& cell);
  Kind kindAt(const Eigen::Vector3d& p) const;
  std::size_t flat(const Index& cell) const {
    return (static_cast<std::size_t>(cell[2]) * counts_[1] + cell[1]) * counts_[0] + cell[0];
  }

  Eigen::Vector3d origin_;  ///< m, corner of the grid
  double cell_ = 0.0;       ///< m
  Index counts_{};          ///< with one layer of free cells all around
  std::vector<Kind> kinds_;
  bool areNone_ = true;
  std::vector<bool> isSkin_;
  std::vector<Eigen::Vector3d> skinVertices_;
  std::vector<Eigen::Vector3i> skinTriangles_;
};

}  // namespace swept::detail
