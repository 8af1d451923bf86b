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

/// The motion of a body in its parent's frame. Frames of the SIMD tier are rotated so that a joint
/// turns about z.
enum class SimdJointKind : std::uint8_t {
  Turn,      ///< revolute and continuous
  Slide,     ///< prismatic
  Planar,    ///< slides, then turns
  Floating,  ///< slides, then turns about an axis that depends on the motion
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

/// Whether the axis depends on the motion.
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

/// One moving body. SimdModel::rounding includes the error of single precision.
struct SimdBody {
  int parent = 0;
  SimdJointKind kind = SimdJointKind::Turn;
  float rotation[9] = {};     ///< parent's frame from the joint's, row by row
  float translation[3] = {};  ///< m, parent's frame
  /// Absolute cosine of the angle between this joint's axis and its parent's, rounded up; negative
  /// unless both turn about an axis that is fixed in the parent.
  float cosine = -1.0F;
};

/// A ball of a link's cover, in the frame of its body. If a body has several pieces of geometry,
/// its first node contains all of them.
struct SimdNode {
  float center[3] = {};  ///< m
  float radius = 0.0F;   ///< m
  float inside = -1.0F;  ///< m, the ball of this radius is in the link's solid; negative: none
  float beyond = 0.0F;   ///< m, how far the ball reaches beyond the link
  std::int32_t firstChild = 0;
  std::int32_t childCount = 0;
  std::int32_t childRow = 0;   ///< first of its rows of SimdModel::children
  std::int32_t geometry = -1;  ///< index into PairModel::robotGeometry; -1: several
};

/// Bounds on the motion of the bodies that move relative to a reference body.
///
/// Rows run over the moving bodies, padded. `arms[step][body]` bounds the distance of each ball
/// centre of the body from the axis of the step's joint while all prismatic joints are at zero; it
/// is 0 if the joint does not carry the body. A motion's slides lengthen it: see Growth. If
/// SimdModel::carried has them, there are no steps, arms and `carried` here.
struct SimdReference {
  struct Step {
    int body = 0;
    int parent = -1;          ///< step; -1: the reference itself
    int grandparent = -1;     ///< step; meaningful when `turnsAfter`
    bool turnsAfter = false;  ///< both this joint and its parent's turn, relative to the reference
  };
  /// Growth of the lever arms per m that a prismatic joint is off zero.
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
  std::vector<int> slot;        ///< per body: its place in the rows; -1: not moved
};

/// The bodies that one joint carries. Each reference has its own arms, and their number grows with
/// the third power of that of the bodies in a chain. If there are too many, these serve all
/// references: see boundCarried.
struct SimdCarried {
  std::vector<int> bodies;  ///< its own one included, ascending
  std::vector<float> arms;  ///< m, of each, see armsAtRest
  std::int32_t around =
      -1;  ///< index into SimdModel::references, that of the body it hangs on; -1: none
};

/// Two bodies with pairs of their geometry to check.
struct SimdBodyPair {
  int bodyA = 0;
  int bodyB = 0;
  int reference = 0;                                 ///< index into SimdModel::references
  std::shared_ptr<const PairSeparationTable> table;  ///< null: none
  float extra = 0.0F;  ///< m, the most that a pair of them keeps beyond the margin, tube included
  float tube = 0.0F;   ///< m, likewise of GeometryPair::tube alone
};

/// A body with eight consecutive ones, for the pairs that are checked.
struct SimdRootRow {
  Row radii;  ///< m, sums of the radii of the balls around all of their geometry
  Row keep;   ///< m, what the pairs must keep
  std::int32_t pairs[kLanes] = {};  ///< index into SimdModel::bodyPairs
  std::uint32_t checked = 0;        ///< lanes that are a pair
  int body = 0;
  int eight = 0;  ///< with bodies 8 eight, 8 eight + 1, ...
};

/// The source of a pair in the model.
struct SimdPairSource {
  int geometry = 0;
  std::int32_t obstacle = -1;  ///< -1: a pair of two links
  int other = 0;               ///< of two links: the second one's geometry
  int bodyPair = 0;            ///< index into SimdModel::bodyPairs
};

/// Robot x world for the SIMD kernels: single precision, eight lanes.
struct SimdModel {
  bool usable = false;
  SharedArray<SimdBody> bodies;  ///< [0] is the model frame
  /// Per body: its parent's frame here from the parent's frame in KinematicModel.
  SharedArray<Eigen::Matrix3d> parentLaneFromParent;
  SharedArray<Eigen::Matrix3d> bodyFromLane;  ///< per body, KinematicModel's frame from this one
  SharedArray<SimdNode> nodes;
  /// Eight children of a node; the last one is repeated to fill a row.
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
  /// Eight balls inside a geometry; the last one of a geometry is repeated to fill its last row.
  struct Probes {
    Row x, y, z;  ///< m, in the body's frame
    Row inside;   ///< m
  };
  SharedArray<Probes> probes;
  SharedArray<InnerBalls> probesOf;  ///< per geometry, into `probes`
  /// Per geometry: where another link may meet it. First a row of balls, the i-th around all of the
  /// i-th row after it. The `count` rows after it are balls inside the geometry, or, for a mesh
  /// without any, points of its surface.
  SharedArray<Probes> meetingRows;
  SharedArray<InnerBalls> meetingRowsOf;  ///< `first` is the row of balls around the others
  std::shared_ptr<const SimdHulls> hulls;
  SharedArray<int> geometryBody;
  /// Those with pairs against the world: first `worldTips` that carry none of the others; of both
  /// kinds the deepest first.
  std::vector<int> worldBodies;
  std::size_t worldTips = 0;
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
  /// m, per pair: what it must keep beyond `margin`. Empty if all margins are the same.
  std::vector<float> extras;
  std::vector<float> obstacleExtras;  ///< m, per obstacle: the largest of its pairs; empty likewise
  ///@{
  /// Of a tube; empty without one.
  std::vector<float> tubes;      ///< m, per pair: GeometryPair::tube
  std::vector<float> worldTube;  ///< m, per body: the largest of its pairs with the world
  std::vector<float> tubeTurn;   ///< rad, per body: how far its joint may be off its value
  /// Per body: whether turns about its own z axis are all that its joint's errors are.
  std::vector<char> errsByTurns;
  ///@}
  SharedArray<int> allBodies;               ///< the moving ones, parents first
  SharedArray<std::vector<int>> ancestors;  ///< per body, itself included, root first
  bool slides = false;                      ///< some joint does not only turn
  bool floats = false;                      ///< some joint is floating
  float margin = 0.0F;                      ///< relative, of positions; see simd_motion.cpp
  float rounding = 0.0F;                    ///< relative, of positions; see frameRounding()
  float reach = 0.0F;    ///< m, see LeverArms::spanAtRest: the largest, without slides
  double farther = 0.0;  ///< m, how much farther prismatic joints reach within their limits
  std::shared_ptr<const PairSeparationTables> tables;  ///< all that were built

  /// m. What the pair must keep beyond `margin`.
  float extraOf(std::uint32_t pair) const { return extras.empty() ? 0.0F : extras[pair]; }
  /// m. How much nearer the tube lets the pair come.
  float tubeOf(std::uint32_t pair) const { return tubes.empty() ? 0.0F : tubes[pair]; }
};

/// All of SimdModel::bodyPairs, those with the same first body together.
std::vector<SimdRootRow> compileRootRows(const SimdModel& simd);

/// Without tables, which addTables adds. `like`: null, or an earlier version for the same robot,
/// group and reference, with its compiled model; common parts are shared.
SimdModel compileSimdModel(const PairModel& model, const PairModel* like = nullptr,
                           const SimdModel* likeSimd = nullptr);

}  // namespace swept::detail
