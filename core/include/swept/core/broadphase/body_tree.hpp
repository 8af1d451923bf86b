// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <limits>
#include <vector>

#include "swept/core/bv/aabb.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/core/shapes.hpp"

namespace swept {

/// The bodies of a static world, in a tree of axis-aligned boxes.
///
/// Immutable: any number of threads may query it. Bodies without a finite box (planes, half-spaces,
/// and bodies with a non-finite pose) are kept in a list and tested in every query. Answers do not
/// depend on earlier queries. Their order is that of the tree, and the same bodies in the same
/// order give the same tree. Queries allocate nothing.
///
/// Pairs are measured at the relative pose rounded to double: `collides` answers for that pose, and
/// `nearest` widens its lower bound by the rounding. World poses are replaced by the nearest rigid
/// ones (`distance.hpp`); bodies() returns these.
class BodyTree {
 public:
  /// A shape with its pose in the world; `id` comes back in the answers.
  struct Body {
    int id;                             ///< chosen by the caller; need not be unique
    Shape shape;                        ///< in its own frame
    Eigen::Isometry3d world_from_body;  ///< pose in the world
  };

  /// Whether any body touches a shape.
  struct Hit {
    /// Separate: proven for every body. Touching: with body `id`. Unknown: no body is known to
    /// touch, and at least one, `id`, is not proven apart (within rounding, or a non-finite pose).
    Contact status = Contact::Unknown;
    int id = -1;  ///< no meaning for Separate
  };

  /// The distance of the nearest body, as an interval.
  struct Nearest {
    double lower = 0.0;  ///< m, proven: no body is nearer; infinity in an empty tree
    double upper = std::numeric_limits<double>::infinity();  ///< m, distance of the two points
    int id = -1;  ///< of the body with pointOfBody; -1 if upper is infinite
    Eigen::Vector3d pointOfShape = Eigen::Vector3d::Zero();  ///< m, world frame
    Eigen::Vector3d pointOfBody = Eigen::Vector3d::Zero();   ///< m, world frame
  };

  BodyTree() = default;
  /// Builds the tree by a binned surface area heuristic: O(n log n). Throws std::invalid_argument
  /// for more than 2^30 bodies.
  explicit BodyTree(std::vector<Body> bodies);

  /// In the order given.
  const std::vector<Body>& bodies() const { return bodies_; }

  /// Calls `visitor(const Body&)` for each body whose world box overlaps `box` (m, world frame),
  /// and for each body without a finite box, until the visitor returns true. Returns whether it
  /// did. A box with a NaN overlaps every body.
  template <typename Visitor>
  bool forEachOverlap(const Aabb& box, Visitor&& visitor) const {
    if (detail::inForeignEnvironment()) {
      return inDefaultEnvironment([&] { return forEachOverlap(box, visitor); });
    }
    for (const int body : aside_)
      if (visitor(bodies_[static_cast<std::size_t>(body)])) return true;
    const std::size_t count = nodes_.size();
    for (std::size_t i = 0; i < count;) {
      const Node& node = nodes_[i];
      if (apart(node.box, box)) {
        i = node.next;
        continue;
      }
      if (node.body >= 0 && visitor(bodies_[static_cast<std::size_t>(node.body)])) return true;
      ++i;
    }
    return false;
  }

  /// Whether the shape touches a body, and the first such body found.
  Hit collides(const Shape& shape, const Eigen::Isometry3d& world_from_shape) const;

  /// The body nearest to the shape, by branch and bound; upper - lower <= tolerance (m) up to
  /// rounding. Overlap gives upper 0. A non-finite pose gives [0, infinity].
  Nearest nearest(const Shape& shape, const Eigen::Isometry3d& world_from_shape,
                  double tolerance = tolerance::kDistance) const;

 private:
  /// Nodes are stored depth-first: the left child of node i is i + 1, and `next` is the first node
  /// after its subtree.
  struct Node {
    Aabb box;  ///< m, world frame, rounded outward
    std::size_t next;
    int body;  ///< into bodies_; -1 for inner nodes
  };
  class Builder;
  /// A ball and a box whose sum contains a shape, in its frame.
  struct LocalBox {
    Eigen::Vector3d middle;  ///< m
    Eigen::Vector3d half;    ///< m
    double radius;           ///< m
  };

  /// Whether the boxes are disjoint. False for NaN. Without branches, since the separating side is
  /// unpredictable.
  static bool apart(const Aabb& a, const Aabb& b) {
    const int outside =
        static_cast<int>(a.lower.x() > b.upper.x()) | static_cast<int>(b.lower.x() > a.upper.x()) |
        static_cast<int>(a.lower.y() > b.upper.y()) | static_cast<int>(b.lower.y() > a.upper.y()) |
        static_cast<int>(a.lower.z() > b.upper.z()) | static_cast<int>(b.lower.z() > a.upper.z());
    return outside != 0;
  }
  static LocalBox localBox(const Shape& shape);
  static bool apart(const LocalBox& a, const LocalBox& b, const Eigen::Isometry3d& a_from_b);
  std::size_t indexOf(const Body& body) const {
    return static_cast<std::size_t>(&body - bodies_.data());
  }
  void measure(const Body& body, const Shape& shape, double shapeExtent,
               const Eigen::Isometry3d& world_from_shape, double tolerance, Nearest& best) const;
  void descend(std::size_t node, const Aabb& box, const Shape& shape, double shapeExtent,
               const Eigen::Isometry3d& world_from_shape, double tolerance, Nearest& best) const;

  std::vector<Body> bodies_;
  std::vector<LocalBox> boxes_;
  std::vector<double> extents_;  ///< m, no point of the body is farther from its origin
  std::vector<Node> nodes_;
  std::vector<int> aside_;  ///< into bodies_
};

}  // namespace swept
