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

/// Triangles whose vertices move: from one frame to the next each goes straight, at constant speed.
/// Triangles are surfaces here and may be degenerate; nothing is welded, dropped or renumbered.
/// Coordinates beyond 1e17 m cost time, for single precision tells little there.
///
/// Holds a hierarchy that follows the vertices in linear time, and builds it anew in the rare case
/// that deformation made its boxes large. Copies are deep.
class DeformingMesh {
 public:
  using Triangle = Eigen::Vector3i;  ///< indices of vertices

  /// Stands still at `vertices` (m). Throws std::invalid_argument for an index out of range, a
  /// coordinate that is not finite, or without triangles.
  static DeformingMesh build(std::span<const Eigen::Vector3d> vertices,
                             std::span<const Triangle> triangles);

  DeformingMesh(const DeformingMesh&);
  DeformingMesh(DeformingMesh&&) noexcept;
  DeformingMesh& operator=(const DeformingMesh&);
  DeformingMesh& operator=(DeformingMesh&&) noexcept;
  ~DeformingMesh();

  /// The step from where the last one ended to `vertices` (m), as many as build() got. Throws
  /// std::invalid_argument for another number of them or a coordinate that is not finite; the mesh
  /// is then as it was. Allocates nothing on one thread unless it builds the hierarchy anew.
  ///
  /// Follows on up to so many threads (0: as many as there are processors), of which it starts all
  /// but the caller's in each call: on fewer where more do not pay or are not to be had. The mesh
  /// is bit for bit the same on any number. Building anew takes one thread.
  void moveTo(std::span<const Eigen::Vector3d> vertices, unsigned threads = 1);
  /// Stands still at `vertices` (m): the next step starts there. Throws as moveTo() does.
  void place(std::span<const Eigen::Vector3d> vertices, unsigned threads = 1);
  /// Builds the hierarchy anew, for the end of the step.
  void rebuild();

  /// As many as build() got.
  std::size_t vertexCount() const;
  /// As many as build() got; impacts name them by index.
  std::size_t triangleCount() const;
  /// How often moveTo() found it worth the time to build the hierarchy anew.
  std::size_t rebuilds() const;
  /// What the hierarchy's boxes have grown to, against those of the triangles, since it was built:
  /// ratio of surface areas, 1 after a build. From kRebuildGrowth on moveTo() builds anew.
  double growth() const;
  static constexpr double kRebuildGrowth = 2.0;  ///< see growth()

  struct Data;
  /// For the queries.
  const Data& data() const { return *data_; }

 private:
  explicit DeformingMesh(std::unique_ptr<Data> data);
  std::unique_ptr<Data> data_;
};

/// What counts as contact during a step, and what is asked.
struct DeformingOptions {
  double separation = 0.0;  ///< m, >= 0. Closer than this, or as close, is contact.
  /// m, >= 0. What keeps more than separation + tolerance is Free, and the time of a contact is
  /// known to within this much relative motion.
  double tolerance = 1e-6;
  /// Look for the first contact in time alone.
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
  /// By the members in their order: triangles first.
  auto operator<=>(const TriangleImpact&) const = default;
};

/// What a query took.
struct DeformingEffort {
  std::int64_t candidates = 0;  ///< pairs of triangles that no box and no plane kept apart
  std::int64_t features = 0;    ///< vertex-face and edge-edge pairs solved
};

/// Contacts of a step. Reuse one result to query without allocating.
struct DeformingResult {
  Verdict verdict = Verdict::Undecided;  ///< Free: nothing meets, proven
  double freeUntil = 0.0;  ///< proven: no contact on [0, freeUntil), and on [0, 1] if Free
  double contactBy = 1.0;  ///< the earliest t with a known contact; 1 unless Collision
  /// Sorted by triangles; with `firstOnly` one of those that come first, if there is any.
  std::vector<TriangleImpact> impacts;
  DeformingEffort effort;  ///< spent, whatever the verdict
};

/// Memory for queries of one thread. No result depends on what it held before. A query that needs
/// no more than earlier ones allocates nothing.
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

/// Which triangles touch one another at the end of the step without sharing a vertex, by index: the
/// pairs that selfCollideMesh() gives, decided exactly, sorted, the smaller index of each first.
/// Looks for no more than `maxPairs` of them. Boxes are looked at eight at a time and not counted:
/// `effort.bvTests` is 0.
void selfCollide(const DeformingMesh& mesh, const MeshCollisionOptions& options,
                 MeshCollisionResult& result, DeformingWorkspace& workspace);
/// Which triangles of two meshes touch at the end of their steps. The same mesh twice is one mesh.
void collide(const DeformingMesh& a, const DeformingMesh& b, const MeshCollisionOptions& options,
             MeshCollisionResult& result, DeformingWorkspace& workspace);

/// Which triangles meet one another during the step, and when first. Nothing is missed, rounding
/// included: every two triangles without a common vertex that come within the separation at some t
/// in [0, 1] are among the impacts. With an option that is not finite the result is Undecided.
///
/// Two triangles with a common vertex touch always and are left out. What else of them can meet,
/// say a vertex of the one and the other's face, belongs to triangles without a common vertex
/// nearly always. Where it does not, as for both ends of a strip of two triangles, it counts, and
/// the two triangles are among the impacts then.
void selfCollideContinuous(const DeformingMesh& mesh, const DeformingOptions& options,
                           DeformingResult& result, DeformingWorkspace& workspace);
/// The same for triangles of two meshes on a common clock. A mesh that stands still is one that was
/// placed.
void collideContinuous(const DeformingMesh& a, const DeformingMesh& b,
                       const DeformingOptions& options, DeformingResult& result,
                       DeformingWorkspace& workspace);

}  // namespace swept
