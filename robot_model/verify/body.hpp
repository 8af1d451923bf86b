// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace swept::verify {

/// The smallest convex set around points, discs and an ellipsoid, grown by `radius`. All in m, in
/// the frame of its body.
struct Element {
  struct Disc {
    Eigen::Vector3d center;
    Eigen::Vector3d axis;  ///< unit
    double radius;
  };
  struct Ellipsoid {
    Eigen::Vector3d center;
    Eigen::Matrix3d axes;  ///< columns: the semi-axes
  };
  std::vector<Eigen::Vector3d> points = {};
  std::vector<Disc> discs = {};
  std::optional<Ellipsoid> ellipsoid = {};
  double radius = 0.0;
  double size = 0.0;  ///< m: sum of the sizes of the terms that coordinates were computed from; 0:
                      ///< only themselves
};

/// The points x with normal . x = offset, or <= offset if `solid`. m.
struct Flat {
  Eigen::Vector3d normal;  ///< unit
  double offset;
  bool solid;
  double size = 0.0;  ///< m: sum of the sizes of the terms that the offset was computed from
};

/// Triangles whose closed components enclose something. m, in the frame of the body.
struct Surface {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;
};

/// A set of convex elements in a tree: node 0 holds all of them. The children of an inner node hold
/// half of its elements each, split in the middle along the longest side of the box of their
/// centres.
class Body {
 public:
  /// A point of an element with the element's radius.
  struct Ball {
    Eigen::Vector3d center;  ///< m
    double radius;           ///< m
  };

  struct Node {
    std::size_t first, last;  ///< elements [first, last)
    int left = -1, right = -1;
    /// For the topmost nodes, which are used most: the points of their elements, without
    /// duplicates. Empty for the others.
    std::vector<Ball> balls = {};
    std::vector<Element> round = {};  ///< elements with discs or ellipsoids
  };

  Body(std::string name, std::vector<Element> elements, std::vector<Flat> flats,
       std::vector<Surface> solids);

  const std::string& name() const { return name_; }
  /// Empty: no element, but perhaps flats.
  const std::vector<Node>& nodes() const { return nodes_; }
  bool isLeaf(int node) const { return nodes_[static_cast<std::size_t>(node)].left < 0; }
  const std::vector<Element>& elements() const { return elements_; }
  const std::vector<Flat>& flats() const { return flats_; }
  const std::vector<Surface>& solids() const { return solids_; }

  /// max of direction . x over the elements of a node. `direction` need not be a unit vector.
  double support(int node, const Eigen::Vector3d& direction) const;
  /// m. Upper bound on the distance of all elements' points from the body's origin, up to rounding.
  double reach() const { return reach_; }
  /// m. Size of the terms in the coordinates of elements and flats: rounding is relative to it. At
  /// least reach().
  double size() const { return size_; }

 private:
  int build(std::size_t first, std::size_t last, std::vector<Eigen::Vector3d>& centers,
            std::vector<std::size_t>& order);

  void gather(Node& node) const;

  std::string name_;
  std::vector<Element> elements_;  ///< in the order of the tree
  std::vector<Flat> flats_;
  std::vector<Surface> solids_;
  std::vector<Node> nodes_;
  double reach_ = 0.0;
  double size_ = 0.0;
};

}  // namespace swept::verify
