// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "graph/motion_boxes.hpp"
#include "swept/robot_model/world.hpp"

namespace swept::detail {

/// Where a body of the world is, for boxes that are to stay apart from it. A body of many parts or
/// points is a grid of cells, with how many of them are occupied up to each corner (F. Crow,
/// Summed-area tables for texture mapping, 1984): so a box asks eight numbers.
class BodySpace {
 public:
  /// The body scaled by `scale`, and grown by `margin` (m) and the rounding of its coordinates, at
  /// `perMetre` of their size.
  BodySpace(const WorldBody& body, double scale, double margin, double perMetre);

  /// Holds all of it.
  const SingleBox& box() const { return box_; }
  /// False: the body, with its margin, is proven to have no point in the box.
  bool touches(const SingleBox& box) const;

 private:
  /// A part: what is in `box`, and along each of three axes within a distance of the middle.
  struct Part {
    SingleBox box;
    BoxProbe probe;       ///< of it
    bool turned = false;  ///< the axes are not those of the model frame
    Eigen::Matrix3f axes = Eigen::Matrix3f::Identity();  ///< rows
    Eigen::Vector3f middle, halfExtents;                 ///< along these
    float slack = 0.0F;                                  ///< m, rounding of what is computed here
  };
  /// n . x <= offset, or within `thickness` of it.
  struct Flat {
    Eigen::Vector3d normal;
    double offset = 0.0;
    double thickness = 0.0;
    bool solid = false;
  };
  void add(const Aabb& local, const Eigen::Isometry3d& world_from_shape, double grown);
  void addFlat(const Eigen::Isometry3d& world_from_shape, const Eigen::Vector3d& normal,
               double offset, double grown, bool solid);
  /// Fills a grid over `all`, which holds them, with `count` boxes, the i-th of which is boxOf(i).
  template <typename BoxOf>
  void fillGrid(const SingleBox& all, std::size_t count, const BoxOf& boxOf);
  int cellOf(int k, double x) const;
  void sumUp();
  /// Of a corner, in occupied_.
  std::size_t place(int x, int y, int z) const {
    return static_cast<std::size_t>(x) * stride_[0] + static_cast<std::size_t>(y) * stride_[1] +
           static_cast<std::size_t>(z) * stride_[2];
  }
  bool gridTouches(const SingleBox& box) const;
  static bool partTouches(const Part& part, const SingleBox& box);
  static bool flatTouches(const Flat& flat, const SingleBox& box);

  SingleBox box_ = emptyBox();
  std::vector<Part> parts_;
  std::vector<Flat> flats_;
  bool isEverywhere_ = false;
  ///@{
  /// Cells of a grid; none: there is no grid.
  Eigen::Vector3d gridLower_, gridUpper_;  ///< m
  std::array<int, 3> cells_{};
  std::array<std::size_t, 3> stride_{};
  double perCell_ = 0.0;                 ///< per m
  std::vector<std::uint32_t> occupied_;  ///< how many cells before each corner are
  ///@}
};

}  // namespace swept::detail
