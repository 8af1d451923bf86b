// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "swept/core/bvh/bv_tree.hpp"
#include "swept/core/triangle_pair.hpp"

namespace swept {

/// The life cycle of a model (Pan, Chitta, Manocha 2012, section III-A).
///
///     Empty -begin-> Building -end-> Built
///     Built, Updated -beginReplace-> Replacing -endReplace-> Built
///     Built, Updated -beginUpdate-> Updating -endUpdate-> Updated
///
/// Replacing forgets the previous positions of the vertices. Updating keeps them: the volumes of an
/// updated model bound each primitive's way from the previous positions to the present ones
/// (straight, per vertex). Queries need Built or Updated. clear() leads back to Empty from any
/// state.
enum class BvhState : std::uint8_t { Empty, Building, Built, Replacing, Updating, Updated };

/// `empty`, `building`, ...: the words in messages of BvhStateError.
std::string_view toString(BvhState state);

/// A call that the state of the model does not allow. what() names the call, the state and the
/// states that allow it: "BvhModel::addTriangle: model is built; allowed: building".
class BvhStateError : public std::logic_error {
 public:
  /// Makes the message; `call` is the function's name without the class.
  BvhStateError(std::string_view call, BvhState state, std::initializer_list<BvhState> allowed);
};

/// How a model updates its hierarchy.
enum class Refresh : std::uint8_t {
  Refit,    ///< new volumes on the same tree: linear, if the fit rule is; for small changes
  Rebuild,  ///< a new tree
};

/// The part of a `BvhModel` that does not depend on its bounding volume: vertices, triangles,
/// state.
///
/// Every call throws BvhStateError in a state that does not allow it, and std::invalid_argument,
/// with the element and the value, for bad input. Either leaves the model as it was. Spans may
/// refer to the model's own vertices and triangles.
class ModelGeometry {
 public:
  /// State of the model, see BvhState.
  BvhState state() const { return state_; }

  /// Empty -> Building. The counts only reserve memory.
  void begin(std::size_t expectedVertices = 0, std::size_t expectedTriangles = 0);

  /// Allowed while Building. Each returns the index of the (first) vertex or triangle added.
  /// Positions are in m.
  int addVertex(const Eigen::Vector3d& position);
  int addTriangle(const Eigen::Vector3i& vertices);  ///< indices of vertices added before
  /// A triangle with its own three vertices (m); none is shared.
  int addTriangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);
  /// The triangles' indices count from the first of these vertices.
  int addMesh(std::span<const Eigen::Vector3d> vertices,
              std::span<const Eigen::Vector3i> triangles);
  /// A point of a cloud: a ball (m). Not allowed together with triangles.
  int addPoint(const Eigen::Vector3d& position, double radius);

  /// Built or Updated -> Replacing; then call replaceVertices().
  void beginReplace();
  /// Allowed while Replacing: positions in m for vertices `first` and following.
  void replaceVertices(std::size_t first, std::span<const Eigen::Vector3d> positions);

  /// Built or Updated -> Updating; present positions become the previous ones. Then call
  /// updateVertices().
  void beginUpdate();
  /// Allowed while Updating: positions in m for vertices `first` and following; the others stand
  /// still.
  void updateVertices(std::size_t first, std::span<const Eigen::Vector3d> positions);

  const std::vector<Eigen::Vector3d>& vertices() const { return vertices_; }  ///< m
  /// m, positions before the last update. Empty unless Updating or Updated.
  const std::vector<Eigen::Vector3d>& previousVertices() const { return previous_; }
  /// Indices into vertices(); empty for a cloud.
  const std::vector<Eigen::Vector3i>& triangles() const { return triangles_; }
  const std::vector<double>& radii() const { return radii_; }  ///< m, per point; empty: all zero
  /// Whether there are no triangles: then each vertex is a primitive.
  bool isPointCloud() const { return triangles_.empty(); }
  /// Number of triangles, or of points of a cloud: the primitives in the leaves of a tree.
  std::size_t primitiveCount() const {
    return isPointCloud() ? vertices_.size() : triangles_.size();
  }
  /// m; present corners of a triangle.
  TriangleCorners corners(int triangle) const {
    const Eigen::Vector3i& t = triangles_[static_cast<std::size_t>(triangle)];
    return {vertices_[t[0]], vertices_[t[1]], vertices_[t[2]]};
  }
  /// m; largest sum of the absolute coordinates of a vertex.
  double extent() const { return extent_; }

  /// Throws BvhStateError, naming `call`, unless the model can be queried.
  void requireUsable(std::string_view call) const;
  /// The same; also throws std::invalid_argument for a point cloud.
  void requireTriangles(std::string_view call) const;

 protected:
  ~ModelGeometry() = default;

  /// Throws BvhStateError, naming `call`, in any other state.
  void requireState(std::string_view call, std::initializer_list<BvhState> allowed) const;
  /// Throws std::invalid_argument without triangles or points.
  void requirePrimitives() const;
  /// Points of all primitives: present ones, or present and previous ones.
  std::vector<Eigen::Vector3d> primitivePoints() const;
  /// Points per primitive in primitivePoints(): 1 or 3, twice that if the model is Updated.
  std::size_t pointsPerPrimitive() const;
  /// Sets the state and recomputes extent().
  void enter(BvhState state);
  /// Resets the geometry to that of a new model.
  void clearGeometry();
  /// Bytes on the heap.
  std::size_t geometryBytes() const;

 private:
  void requireFinite(std::string_view call, std::size_t index, const Eigen::Vector3d& p) const;
  void requireVertices(std::string_view call, const Eigen::Vector3i& triangle, std::size_t index,
                       std::size_t count) const;
  /// Gives radius 0 to vertices that were added between points with radii.
  void giveRadii();
  void overwrite(std::string_view call, std::size_t first,
                 std::span<const Eigen::Vector3d> positions);

  BvhState state_ = BvhState::Empty;
  std::vector<Eigen::Vector3d> vertices_;
  std::vector<Eigen::Vector3d> previous_;
  std::vector<Eigen::Vector3i> triangles_;
  std::vector<double> radii_;
  double extent_ = 0.0;
};

}  // namespace swept
