// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "model/shared_array.hpp"
#include "simd/compile/obstacles.hpp"
#include "simd/compile/row.hpp"
#include "simd/compile/simd_hulls.hpp"

namespace swept::detail {

struct PairModel;
struct PairSeparationTable;
struct PairSeparationTables;

/// How a body moves in its parent's frame. Frames of the lane tier are turned so that a joint turns
/// about z.
enum class SimdJointKind : std::uint8_t {
  Turn,      ///< revolute and continuous
  Slide,     ///< prismatic
  Planar,    ///< slides, then turns
  Floating,  ///< slides, then turns about an axis that the motion chooses
};

constexpr bool slides(SimdJointKind kind) {
  switch (kind) {
    case SimdJointKind::Slide:
    case SimdJointKind::Planar:
    case SimdJointKind::Floating:
      return true;
    case SimdJointKind::Turn:
      break;
  }
  return false;
}

constexpr bool turns(SimdJointKind kind) {
  switch (kind) {
    case SimdJointKind::Turn:
    case SimdJointKind::Planar:
    case SimdJointKind::Floating:
      return true;
    case SimdJointKind::Slide:
      break;
  }
  return false;
}

/// The motion chooses the axis.
constexpr bool floats(SimdJointKind kind) {
  switch (kind) {
    case SimdJointKind::Floating:
      return true;
    case SimdJointKind::Turn:
    case SimdJointKind::Slide:
    case SimdJointKind::Planar:
      break;
  }
  return false;
}

/// One moving body. Single precision: what that costs is part of SimdModel::rounding.
struct SimdBody {
  int parent = 0;
  SimdJointKind kind = SimdJointKind::Turn;
  float rotation[9] = {};     ///< parent's frame from the joint's, row by row
  float translation[3] = {};  ///< m, parent's frame
  /// Of the angle between this joint's axis and its parent's, absolute, rounded up; negative where
  /// not both turn about an axis that is fixed in the parent.
  float cosine = -1.0F;
};

/// A ball of a link's cover, in the frame of its body. The first node of a body that has several
/// pieces of geometry holds all of them.
struct SimdNode {
  float center[3] = {};  ///< m
  float radius = 0.0F;   ///< m
  float inside = -1.0F;  ///< m, the ball of this radius is in the link's solid; negative: none
  float beyond = 0.0F;   ///< m, how far the ball reaches beyond the link
  std::int32_t firstChild = 0;
  std::int32_t childCount = 0;
  std::int32_t childRow = 0;   ///< of SimdModel::children, the first of as many as they fill
  std::int32_t geometry = -1;  ///< index into PairModel::robotGeometry; -1: several
};

/// Bounds on how the bodies that move relative to a reference body do so.
///
/// Rows go over the moving bodies, padded; `arms[step][body]` bounds the distance of each ball
/// centre of the body from the axis of the step's joint while all prismatic joints are at zero, 0
/// where that does not carry the body. What a motion slides makes it longer: see Growth. Where
/// SimdModel::carried has them, there are no steps, arms and `carried` here.
struct SimdReference {
  struct Step {
    int body = 0;
    int parent = -1;          ///< step; -1: the reference itself
    int grandparent = -1;     ///< step; meaningful when `turnsAfter`
    bool turnsAfter = false;  ///< both this joint and its parent's turn, relative to the reference
  };
  /// By how much more, per m that a prismatic joint is off zero.
  struct Growth {
    int slide = 0;            ///< index into SimdModel::bodies
    std::vector<Row> shares;  ///< as `arms`
  };
  int body = 0;
  std::vector<Step> steps;      ///< parents first
  int rows = 0;                 ///< per step
  std::vector<Row> arms;        ///< m, [step * rows + row]
  std::vector<Row> carried;     ///< 1 or 0, likewise
  std::vector<Growth> growths;  ///< one per prismatic joint behind one that turns
  std::vector<int> slot;        ///< per body: where it is in the rows; -1: not moved
};

/// The bodies that one joint carries. References have arms each of their own, whose number grows
/// with the third power of that of the bodies in a chain; where that is too many, these are for all
/// references: see boundCarried.
struct SimdCarried {
  std::vector<int> bodies;   ///< its own one included, ascending
  std::vector<float> arms;   ///< m, of each, see armsAtRest
  std::int32_t around = -1;  ///< of SimdModel::references, that of the body it hangs on; -1: none
};

/// Two bodies with pairs of their geometry to check.
struct SimdBodyPair {
  int bodyA = 0;
  int bodyB = 0;
  int reference = 0;                                 ///< index into SimdModel::references
  std::shared_ptr<const PairSeparationTable> table;  ///< null: none
  float extra = 0.0F;  ///< m, most that a pair of them keeps beyond the margin
};

/// A body with eight consecutive ones, as far as pairs of them are checked.
struct SimdRootRow {
  Row radii;                        ///< m, sums of those of the balls around all of their geometry
  Row keep;                         ///< m, what the pairs have to keep
  std::int32_t pairs[kLanes] = {};  ///< index into SimdModel::bodyPairs
  std::uint32_t checked = 0;        ///< lanes that are a pair
  int body = 0;
  int eight = 0;  ///< with bodies 8 eight, 8 eight + 1, ...
};

/// What a pair of the model is here.
struct SimdPairSource {
  int geometry = 0;
  std::int32_t obstacle = -1;  ///< -1: a pair of two links
  int other = 0;               ///< of two links: the second one's geometry,
  int bodyPair = 0;            ///< and of which of SimdModel::bodyPairs it is one
};

/// Robot x world for the vector kernels: single precision, eight lanes.
struct SimdModel {
  bool usable = false;
  SharedArray<SimdBody> bodies;  ///< [0] is the model frame
  /// Per body: its parent's frame as it is here, from the parent's frame in KinematicModel.
  SharedArray<Eigen::Matrix3d> parentLaneFromParent;
  SharedArray<Eigen::Matrix3d> bodyFromLane;  ///< per body, KinematicModel's frame from this one
  SharedArray<SimdNode> nodes;
  /// Eight children of a node; the last one is repeated to fill up a row.
  struct Children {
    Row x, y, z;  ///< m, in the body's frame
    Row radius;   ///< m
  };
  SharedArray<Children> children;
  SharedArray<std::int32_t> rootOfBody;      ///< -1: no geometry
  SharedArray<std::int32_t> rootOfGeometry;  ///< -1: none
  /// Per geometry: balls inside it, as nodes without children.
  struct InnerBalls {
    std::int32_t first = 0;
    std::int32_t count = 0;
  };
  SharedArray<InnerBalls> innerBalls;
  /// Eight balls inside a geometry; the last ones of a geometry are repeated to fill it up.
  struct Probes {
    Row x, y, z;  ///< m, in the body's frame
    Row inside;   ///< m
  };
  SharedArray<Probes> probes;
  SharedArray<InnerBalls> probesOf;  ///< per geometry, into `probes`
  /// Per geometry: where another link may be found to meet it. First a row of balls, the i-th
  /// around all of the i-th row behind it; these, `count` of them, are balls inside the geometry,
  /// or of a mesh that has none points of its surface.
  SharedArray<Probes> meetingRows;
  SharedArray<InnerBalls> meetingRowsOf;  ///< `first` is the row of balls around the others
  std::shared_ptr<const SimdHulls> hulls;
  SharedArray<int> geometryBody;
  std::vector<int> worldBodies;           ///< those with pairs against the world, deepest first
  SharedArray<SimdReference> references;  ///< [0]: the model frame
  SharedArray<SimdCarried> carried;       ///< per body, of its joint; empty but for many bodies
  std::vector<SimdBodyPair> bodyPairs;
  std::vector<SimdRootRow> rootRows;  ///< of all of bodyPairs
  SimdObstacles obstacles;
  /// Index of the pair of a geometry and a world geometry: [geometry * obstacles + obstacle]; -1:
  /// not checked.
  std::vector<std::int32_t> pairOf;
  std::vector<std::int32_t> pairOfGeometries;  ///< of two links, likewise: [a * geometries + b]
  std::vector<SimdPairSource> sources;         ///< per pair of the model
  /// m, per pair: what it has to keep beyond `margin`. Empty where all margins are the same.
  std::vector<float> extras;
  std::vector<float> obstacleExtras;  ///< m, per obstacle: the most of its pairs; empty likewise
  SharedArray<int> allBodies;         ///< that move, parents first
  SharedArray<std::vector<int>> ancestors;  ///< per body, itself included, root first
  bool slides = false;                      ///< some joint does not only turn
  bool floats = false;                      ///< some joint is floating
  float margin = 0.0F;                      ///< m, the least of all pairs
  float rounding = 0.0F;                    ///< relative, of positions; see frameRounding()
  float reach = 0.0F;    ///< m, see LeverArms::spanAtRest: the largest, but for what slides
  double farther = 0.0;  ///< m, how much farther prismatic joints reach within their limits
  std::shared_ptr<const PairSeparationTables> tables;  ///< all that were built

  /// m. What the pair has to keep beyond `margin`.
  float extraOf(std::uint32_t pair) const { return extras.empty() ? 0.0F : extras[pair]; }
};

/// All of SimdModel::bodyPairs, those with the same first body side by side.
std::vector<SimdRootRow> compileRootRows(const SimdModel& simd);

/// Without tables, which addTables adds. `like`: null, or an earlier version for the same robot,
/// group and reference, with what was compiled of it; what the two have in common is shared.
SimdModel compileSimdModel(const PairModel& model, const PairModel* like = nullptr,
                           const SimdModel* likeSimd = nullptr);

}  // namespace swept::detail
