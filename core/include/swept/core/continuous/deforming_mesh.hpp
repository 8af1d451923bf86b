// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "swept/core/traversal/mesh_collision.hpp"
#include "swept/core/verdict.hpp"

namespace swept {

/// Triangles whose vertices move straight, at constant speed, from one frame to the next. Triangles
/// are surfaces here and may be degenerate; nothing is welded, dropped or renumbered. Coordinates
/// beyond 1e17 m cost time, since single precision separates little there.
///
/// Holds a hierarchy that follows the vertices in linear time, and rebuilds it in the rare case
/// that deformation made its boxes large. Copies are deep.
class DeformingMesh {
 public:
  using Triangle = Eigen::Vector3i;  ///< indices of vertices

  /// A mesh that stands still at `vertices` (m). Throws std::invalid_argument for an index out of
  /// range, a non-finite coordinate, or without triangles.
  static DeformingMesh build(std::span<const Eigen::Vector3d> vertices,
                             std::span<const Triangle> triangles);

  DeformingMesh(const DeformingMesh&);
  DeformingMesh(DeformingMesh&&) noexcept;
  DeformingMesh& operator=(const DeformingMesh&);
  DeformingMesh& operator=(DeformingMesh&&) noexcept;
  ~DeformingMesh();

  /// Makes a step from the end of the last one to `vertices` (m), as many as build() got. Throws
  /// std::invalid_argument for another number or a non-finite coordinate; the mesh is then
  /// unchanged. Allocates nothing on one thread unless it rebuilds the hierarchy.
  ///
  /// Uses up to `threads` threads (0: as many as processors), and starts all but the caller's in
  /// each call. It uses fewer if more do not pay or are not available. The mesh is bit for bit the
  /// same for any number. A rebuild uses one thread.
  void moveTo(std::span<const Eigen::Vector3d> vertices, unsigned threads = 1);
  /// Sets the mesh still at `vertices` (m): the next step starts there. Throws as moveTo() does.
  void place(std::span<const Eigen::Vector3d> vertices, unsigned threads = 1);
  /// Rebuilds the hierarchy for the end of the step.
  void rebuild();

  /// Number of vertices given to build().
  std::size_t vertexCount() const;
  /// Number of triangles given to build(); impacts name them by index.
  std::size_t triangleCount() const;
  /// How often moveTo() rebuilt the hierarchy.
  std::size_t rebuilds() const;
  /// Growth of the hierarchy's boxes since it was built, relative to those of the triangles: a
  /// ratio of surface areas, 1 after a build. From kRebuildGrowth on moveTo() rebuilds.
  double growth() const;
  static constexpr double kRebuildGrowth = 2.0;  ///< see growth()

  struct Data;
  /// For the queries.
  const Data& data() const { return *data_; }

 private:
  explicit DeformingMesh(std::unique_ptr<Data> data);
  std::unique_ptr<Data> data_;
};

/// What counts as contact during a step, and what to find.
struct DeformingOptions {
  double separation = 0.0;  ///< m, >= 0. Closer than this, or as close, is contact.
  /// m, >= 0. Triangles that keep more than separation + tolerance are Free, and the time of a
  /// contact is known to within this much relative motion.
  double tolerance = 1e-6;
  /// Find only the first contact in time.
  bool firstOnly = false;
};

/// Two triangles that meet during a step.
struct TriangleImpact {
  int first;   ///< triangle of the first mesh; the smaller index of two of one mesh
  int second;  ///< triangle of the second mesh, or of the same one
  /// Collision; or Undecided in the rare case that the search for a contact was cut short.
  Verdict verdict;
  /// Proven: more than the separation apart on [0, freeUntil). 0 if they touch at the start.
  double freeUntil;
  /// A t at which they are at most separation + tolerance apart; 1 if Undecided.
  double contactBy;
  /// Ordered by the members in their order: triangles first.
  auto operator<=>(const TriangleImpact&) const = default;
};

/// The effort of a query.
struct DeformingEffort {
  std::int64_t candidates = 0;  ///< pairs of triangles that no box and no plane separated
  std::int64_t features = 0;    ///< vertex-face and edge-edge pairs solved
};

/// Contacts of a step. Reuse one result to query without allocating.
struct DeformingResult {
  Verdict verdict = Verdict::Undecided;  ///< Free: nothing meets, proven
  double freeUntil = 0.0;  ///< proven: no contact on [0, freeUntil), and on [0, 1] if Free
  double contactBy = 1.0;  ///< the earliest t with a known contact; 1 unless Collision
  /// Sorted by triangles; with `firstOnly` one of the first contacts, if there is any.
  std::vector<TriangleImpact> impacts;
  DeformingEffort effort;  ///< spent, whatever the verdict
};

/// Memory for queries of one thread. No result depends on its content. A query that needs no more
/// than earlier ones allocates nothing.
class DeformingWorkspace {
 public:
  DeformingWorkspace();
  DeformingWorkspace(DeformingWorkspace&&) noexcept;
  DeformingWorkspace& operator=(DeformingWorkspace&&) noexcept;
  ~DeformingWorkspace();

  struct Data;
  /// For the queries.
  Data& data() { return *data_; }

 private:
  std::unique_ptr<Data> data_;
};

/// Finds which triangles touch each other at the end of the step without sharing a vertex, by
/// index: the pairs that selfCollideMesh() gives, decided exactly, sorted, the smaller index of
/// each first. Finds at most `maxPairs` of them. Boxes are tested eight at a time and not counted:
/// `effort.bvTests` is 0.
void selfCollide(const DeformingMesh& mesh, const MeshCollisionOptions& options,
                 MeshCollisionResult& result, DeformingWorkspace& workspace);
/// Finds which triangles of two meshes touch at the end of their steps. If both are the same
/// object, this is selfCollide().
void collide(const DeformingMesh& a, const DeformingMesh& b, const MeshCollisionOptions& options,
             MeshCollisionResult& result, DeformingWorkspace& workspace);

/// Finds which triangles meet each other during the step, and when first. Nothing is missed,
/// rounding included: every two triangles without a common vertex that come within the separation
/// at some t in [0, 1] are among the impacts. With a non-finite option the result is Undecided.
///
/// Two triangles with a common vertex always touch and are left out. If other features of them
/// meet, say a vertex of one and the other's face, these features nearly always belong also to
/// triangles without a common vertex. If they do not, as at both ends of a strip of two triangles,
/// the two triangles are among the impacts.
void selfCollideContinuous(const DeformingMesh& mesh, const DeformingOptions& options,
                           DeformingResult& result, DeformingWorkspace& workspace);
/// The same for triangles of two meshes with a common clock. For a mesh that stands still, use
/// place().
void collideContinuous(const DeformingMesh& a, const DeformingMesh& b,
                       const DeformingOptions& options, DeformingResult& result,
                       DeformingWorkspace& workspace);

}  // namespace swept
