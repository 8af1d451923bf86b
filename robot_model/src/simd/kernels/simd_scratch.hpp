// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kinematics/motion_model.hpp"
#include "simd/compile/row.hpp"

namespace swept::detail {

struct SimdModel;
class ExactOracle;

/// One joint's share of a motion, t in [0, 1]. Its size is a power of two, since it is looked up
/// all the time.
struct alignas(32) SimdJointMotion {
  float angle = 0.0F;       ///< rad, at t = 0
  float angleRate = 0.0F;   ///< rad per unit t
  float slide[3] = {};      ///< m, parent's frame, at t = 0
  float slideRate[3] = {};  ///< m per unit t
  float rotation[9] = {};   ///< Floating: replaces SimdBody::rotation
  float after[9] = {};      ///< Floating: applied to the body before it turns
  float spin = 0.0F;        ///< rad per unit t, at least |angleRate|
  float speed = 0.0F;       ///< m per unit t, at least |slideRate|
  float slid = 0.0F;  ///< m, upper bound on its distance from zero during the motion; 0: only turns
  float acceleration = 0.0F;      ///< m per unit t squared, bounds that of the slide
  float spinAcceleration = 0.0F;  ///< rad per unit t squared, bounds that of the rotation
};

/// Frame and velocity field of one body in all lanes: p has velocity linear + angular x p.
struct SimdBodyState {
  Row rotation[9];
  Row origin[3];   ///< m
  Row angular[3];  ///< rad per unit t
  Row linear[3];   ///< m per unit t
};

/// The ball around all of a body's geometry: its centre is at + s by, |s| <= 1.
struct SimdRoot {
  Row at[3];  ///< m
  Row by[3];  ///< m, half the way in the sub-interval; zero at rest
};

/// An obstacle or a pair with the lanes in which it is open.
struct SimdHit {
  std::int32_t index = 0;
  std::uint32_t lanes = 0;
};

/// Two balls that are proven to be inside two bodies meet, or a ball and an obstacle.
struct SimdContact {
  std::uint32_t pair = 0;
  float point[3] = {};  ///< m, in the link's solid by more than rounding
  float inside = 0.0F;  ///< m, by how much
};

/// The open pair and the lane in which the two covers overlap most at the middle.
struct LikelyContact {
  std::uint32_t pair = 0;
  int lane = -1;
  float depth = 0.0F;  ///< m, minus more than half of how far the covers reach beyond the links
};

enum class SimdMode : std::uint8_t {
  Motion,  ///< eight sub-intervals
  State,   ///< the motion's start in all lanes, at rest
  States,  ///< eight states with given angles and slides
};

/// Eight sub-intervals of a motion, or states, and the results about them.
struct SimdBlock {
  Row time;                ///< of the middles
  Row half;                ///< half widths, in units of t
  std::vector<Row> angle;  ///< rad, per body
  std::vector<Row> slide;  ///< m, 3 per body
  /// `angle` and `slide` are given, and, for a motion, their rates. Otherwise a motion's rates are
  /// constant.
  bool given = false;
  std::vector<Row> angleRate;         ///< rad per unit t, where it is given
  std::vector<Row> slideRate;         ///< m per unit t, likewise
  std::vector<SimdBodyState> states;  ///< per body
  std::vector<SimdRoot> roots;        ///< per body; of those that have geometry
  /// Open pairs, with their lanes in openLanes.
  std::vector<std::uint32_t> open;
  std::vector<std::uint8_t> openLanes;  ///< per pair of the model
  /// The open ones for which not the motion but the covers are too coarse.
  std::vector<std::uint8_t> finalLanes;
  SimdMode mode = SimdMode::Motion;
  bool stopAtContact = true;
  /// Lanes with a contact, or after one; these are not tested any more.
  std::uint32_t contactLanes = 0;
  SimdContact contacts[kLanes];
  LikelyContact likelyContact;
};

/// Bounds on the motion of every ball centre relative to a reference.
struct SimdBounds {
  std::vector<Row> acceleration;  ///< m per unit t squared; lanes: bodies
};

/// A ball of a cover for which an obstacle's field is too coarse. The exact question: is the
/// obstacle farther than the radius from the segments x +- g?
struct SimdQuery {
  Row x[3];    ///< m
  Row g[3];    ///< m
  Row radius;  ///< m
  Row depth;   ///< m; as for markUnresolved
  std::int32_t node;
  std::int32_t obstacle;
  std::uint32_t pair;
  std::uint32_t lanes;
  std::uint32_t outside;  ///< lanes in which the obstacle does not contain x
  bool final;             ///< shorter intervals would not help
  bool divides;           ///< the balls below the node may answer what it cannot
};

struct SimdScratch {
  explicit SimdScratch(const SimdModel& model);
  void restBase(const SimdModel& model);
  std::vector<SimdJointMotion> motion;
  JointMotion slide;               ///< of one joint, while that is compiled
  std::vector<SimdBounds> bounds;  ///< per reference
  std::vector<float> together;     ///< rad per unit t, per body: it and its parent turning
  std::vector<float> turning;      ///< rad per unit t, per step of a reference
  std::vector<float> turned;       ///< its factor of the arms
  std::vector<float> slid;
  /// For boundCarried, per body; empty except for many bodies.
  struct Nested {
    std::vector<double> turning;  ///< rad per unit t, relative to the model frame
    std::vector<double> excess;   ///< rad per unit t, d of its lemma, where the joint is c
    std::vector<double> carried;  ///< m per unit t, sum of w of the joints on the way so far
    std::vector<double> driven;   ///< m per unit t squared, of 2 V w + s^2 arm
    std::vector<double> slid;     ///< m, of SimdJointMotion::slid on the way to it
  };
  Nested nested;
  SimdBlock block;
  std::vector<SimdHit> hits;  ///< a stack
  /// A cover that the walk is going to divide, and the hits that it is not apart from.
  struct WorldVisit {
    int body = 0;
    std::int32_t node = 0;
    std::size_t first = 0;
    std::size_t last = 0;
  };
  std::vector<WorldVisit> worldVisits;
  struct SelfVisit {
    int bodyPair = 0;
    std::int32_t nodeA = 0;
    std::int32_t nodeB = 0;
    std::uint32_t lanes = 0;
  };
  std::vector<SelfVisit> selfVisits;
  /// Two balls of one state that are not proven apart.
  struct BallPair {
    std::int32_t nodeA = 0;
    std::int32_t nodeB = 0;
    float atA[3] = {};     ///< m
    float atB[3] = {};     ///< m
    float squared = 0.0F;  ///< m^2, of the distance of their centres
  };
  /// The pairs that a state's walk is going to divide.
  struct StateVisit {
    int bodyPair = 0;
    std::uint32_t pair = 0;
    float spread = 0.0F;  ///< square of the distance of the centres by the sum of the radii
    BallPair balls;
  };
  std::vector<StateVisit> stateVisits;
  /// Eight bodies in one state: the centres of the balls around all of their geometry.
  struct Roots {
    Row at[3];  ///< m
  };
  std::vector<Roots> rootsOfEight;
  std::vector<SimdQuery> queries;
  ExactOracle* oracle = nullptr;  ///< of the motion that is searched; null: none is
  float rounding = 0.0F;          ///< m, of this motion
  bool curved = false;            ///< its rates change
  bool withinLimits = false;      ///< the whole motion; else nothing that rests on the limits holds
  std::vector<std::uint32_t> wanted;      ///< pairs of the block
  std::vector<std::uint8_t> wantedLanes;  ///< per pair of the model
  std::vector<SimdHit> asked;
  std::vector<char> bodyWanted;
  std::vector<int> bodies;
};

}  // namespace swept::detail
