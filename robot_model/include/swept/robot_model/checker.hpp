// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "swept/core/shapes.hpp"
#include "swept/core/tolerances.hpp"
#include "swept/core/verdict.hpp"
#include "swept/robot_model/attached_body.hpp"
#include "swept/robot_model/checker_results.hpp"
#include "swept/robot_model/collision_rules.hpp"
#include "swept/robot_model/configuration.hpp"
#include "swept/robot_model/robot.hpp"
#include "swept/robot_model/world.hpp"

namespace swept {

namespace detail {
struct CheckerModel;
struct WorkspaceData;
}  // namespace detail

/// What is checked, how far apart things have to be, and how hard to try.
struct CheckerOptions {
  /// m. Free means: every checked pair keeps more than this, or than what the rules say.
  double margin = 0.0;
  /// m. A motion that keeps more than margin + tolerance everywhere is Free, never Undecided.
  double tolerance = tolerance::kMotion;
  /// All of the robot's variables; those outside the group keep these values (wholeStateOf() has
  /// them by name). Default: Robot::defaultState().
  std::optional<Eigen::VectorXd> reference = {};
  /// Cap on the intervals examined per motion; a motion that needs more is Undecided. So is one
  /// that needs more than 64 times as many looks at a pair of shapes, beyond the first at each, or
  /// as many sub-intervals in single precision; and one of which more than 2^24 pairs would have to
  /// wait for shorter intervals.
  int maxIntervals = tolerance::kMaxIntervals;
  /// Cap on the pairs of shapes that are checked, some 300 bytes each, and on the pairs of bodies.
  std::size_t maxPairs = 10'000'000;
  /// Above what the SRDF says, and `margin`. Of a pair of links, of what is said explicitly the
  /// strongest counts: these rules, layer by layer; then the SRDF's `<enable_collisions>`; then its
  /// `<disable_collisions>` and `<disable_default_collisions>`; then the defaults: a joint connects
  /// the two. Of an attached body: these rules, then its touch links and the link that has it.
  CollisionRules rules = {};
  /// What links carry.
  std::vector<AttachedBody> attached = {};
  ///@{
  /// m. In the place of `margin` for pairs of two links or attached bodies, and for pairs with the
  /// world, moving obstacles among it.
  std::optional<double> selfMargin = {}, worldMargin = {};
  ///@}

  /// m. What pairs keep of which no rule says anything. `selfPair`: as Witness::selfPair.
  double marginOf(bool selfPair) const {
    return (selfPair ? selfMargin : worldMargin).value_or(margin);
  }
};

class Checker;

/// Scratch memory for one thread. No result depends on what it held before. It grows when it is
/// used with another checker than before; used with one, queries but reportState()
/// allocate nothing.
class Workspace {
 public:
  /// For this checker and its versions; any other may use it too, see above.
  explicit Workspace(const Checker& checker);
  Workspace(Workspace&&) noexcept;
  Workspace& operator=(Workspace&&) noexcept;
  ~Workspace();

 private:
  friend class Checker;
  std::unique_ptr<detail::WorkspaceData> data_;
};

/// Validity of states and motions of one group of a robot in one world. Immutable: any number of
/// threads may use one Checker, each with a Workspace of its own.
///
/// A configuration has the values of the group's variables, in a vector of whichever kind (see
/// configuration.hpp). If the world has moving obstacles, one more follows: the time on their
/// clock, in s.
///
/// The motion from q0 to q1 is q(t) = q0 + t (q1 - q0), cyclic variables the shorter way, floating
/// orientations by slerp along the shorter arc, mimicking joints following. Checked are: each link
/// that the group moves, and each body attached to one, against each world body, and each pair of
/// links or attached bodies whose relative pose the group changes, unless the rules, the SRDF, or
/// by default a joint between the two, leave the pair out: see CheckerOptions::rules. Queries never
/// throw on configurations of the right size (std::invalid_argument otherwise).
///
/// What changes makes a new version: `with...` and `without...` return another Checker that shares
/// with this one what is the same, and is built in a fraction of the time. This one stays as it is,
/// for whoever uses it.
class Checker {
 public:
  /// Throws std::invalid_argument for an unknown group, a negative or non-finite margin (of
  /// either kind) or tolerance, a reference of the wrong size, not finite or with a quaternion
  /// without direction, a rule that names a body that is not there, an attached body whose link or
  /// touch link is not there, whose name is taken, or with a shape or pose that AttachedBody does
  /// not allow, and for more pairs than CheckerOptions::maxPairs.
  Checker(std::shared_ptr<const Robot> robot, std::string_view group,
          std::shared_ptr<const World> world, const CheckerOptions& options = {});

  /// In another world. Rules that name a body that was in the world, and is no more, are dropped.
  /// Throws std::invalid_argument for null, a body with the name of an attached one, and a moving
  /// obstacle with that of a link.
  Checker withWorld(std::shared_ptr<const World> world) const;
  ///@{
  /// The world with one more body, here of one shape. Throws as World::add and withWorld.
  Checker withBody(WorldBody body) const;
  Checker withBody(std::string name, Shape shape, const Eigen::Isometry3d& world_from_shape) const;
  ///@}
  /// The world with this body in the place of the one of the same name, and all rules kept: what a
  /// deforming surface (TriangleMesh::moved), or a sensor's next cloud, is for planners that start
  /// from now on. Takes time in proportion to what the body is made of. Throws as World::replace.
  Checker withReplaced(WorldBody body) const;
  /// The same with a body of one shape.
  Checker withReplaced(std::string name, Shape shape,
                       const Eigen::Isometry3d& world_from_shape) const;
  /// The world with one more moving obstacle: a configuration has a time then. Throws as World::add
  /// and withWorld.
  Checker withObstacle(MovingObstacle obstacle) const;
  /// The world without a body or moving obstacle. Throws std::invalid_argument for a name that is
  /// not there.
  Checker withoutBody(std::string_view name) const;
  ///@{
  /// With one more attached body, here of one shape. Throws as the constructor.
  Checker withAttached(AttachedBody body) const;
  Checker withAttached(std::string name, std::string link, Shape shape,
                       const Eigen::Isometry3d& link_from_shape,
                       std::vector<std::string> touchLinks = {}) const;
  ///@}
  /// Throws std::invalid_argument for a name that is not there.
  Checker withoutAttached(std::string_view name) const;
  /// Instead of the ones so far. A pair that has to keep more than it had to when the first version
  /// was made, and one with a scaled body, may take more time than in a Checker made with these
  /// rules.
  Checker withRules(CollisionRules rules) const;

  /// An attached body where it is at a configuration, as a body of the world: what a gripper lets
  /// go of. Throws std::invalid_argument for a name that is not there, and a configuration in which
  /// no pose is known (see checkState).
  WorldBody detachedBody(std::string_view attached, ConfigurationView q) const;

  ///@{
  /// What this version checks. The references live as long as it does.
  const Robot& robot() const;
  const World& world() const;
  const Group& group() const;
  const CheckerOptions& options() const;
  ///@}
  int dimension() const;  ///< size of a configuration of the group

  /// Free: proven. Collision: witnessed. Undecided: within rounding of the margin, not finite, or a
  /// prismatic value more than tolerance::kLimit outside its limits (what is out of reach up to
  /// there is not looked at). The answer is about `q` as it is, not about what limits would make of
  /// it.
  Verdict checkState(ConfigurationView q, Workspace& workspace) const;
  /// The same verdicts for many states, which follow each other in `states` or are the columns of a
  /// matrix; faster than one by one. Throws std::invalid_argument unless there is one verdict for
  /// each.
  void checkStates(PackedConfigurations states, std::span<Verdict> verdicts,
                   Workspace& workspace) const;
  /// The same on up to so many threads of oneTBB's (0: as many as there are processors), whatever
  /// their number. There are no more than the program lets oneTBB have, which is left as it is.
  void checkStates(PackedConfigurations states, std::span<Verdict> verdicts,
                   unsigned threads = 0) const;
  /// Every violating pair and the clearance. Measures distances where checkState proves them large
  /// enough: about a millisecond for an arm, hundreds to thousands of times what that takes.
  StateReport reportState(ConfigurationView q, Workspace& workspace) const;
  /// m. Proven lower bound of the least distance over all checked pairs; 0 in contact or when not
  /// finite. Takes as long as reportState: nothing to ask while planning.
  double clearance(ConfigurationView q, Workspace& workspace) const;
  /// Negative in contact; more work than clearance(). `gradient`, if not empty, receives the
  /// derivatives of the pair's signed distance by the values of the configuration (m per rad, m per
  /// m, m per s; of a quaternion's components as it is scaled to unit length): zero where `normal`
  /// is. Where several pairs are equally near, of one of them. Throws std::invalid_argument for a
  /// gradient that has another size than a configuration.
  SignedClearance signedClearance(ConfigurationView q, Workspace& workspace,
                                  ConfigurationSpan gradient = {}) const;

  /// What is proven about the motion from one configuration to another. Undecided, too, where an
  /// end is not finite. Limits do not enter it, but for those of prismatic joints (see checkState):
  /// an end that is a little beyond a limit is where it is given.
  /// Every query gives the same verdict.
  MotionCertificate certifyMotion(ConfigurationView from, ConfigurationView to,
                                  Workspace& workspace,
                                  MotionQuery query = MotionQuery::FirstContact) const;
  /// Many at once, which follow each other in `from` and `to`, on up to so many threads, as
  /// checkStates has them. The certificates do not depend on their number. Throws
  /// std::invalid_argument unless there is one certificate for each.
  void certifyMotions(PackedConfigurations from, PackedConfigurations to,
                      std::span<MotionCertificate> certificates,
                      MotionQuery query = MotionQuery::FirstContact, unsigned threads = 0) const;
  /// Of each kind of pairs that is asked for: upper - lower <= accuracy (m), and lower >= upper / 2
  /// while upper >= accuracy / 50, unless the cap on intervals ends the search. For a path see
  /// pathClearance().
  MotionClearance motionClearance(ConfigurationView from, ConfigurationView to, double accuracy,
                                  Workspace& workspace,
                                  ClearanceQuery query = ClearanceQuery::ByKind) const;

  /// Each variable is within its limits, or at most tolerance::kLimit beyond (isWithin()). False
  /// for what is not finite. Who wants the robot at the limit then uses takeToLimits() first.
  bool withinLimits(ConfigurationView q) const;
  /// The configuration at t on the motion that certifyMotion checks.
  Eigen::VectorXd interpolate(ConfigurationView from, ConfigurationView to, double t) const;
  /// The same into `q`, which is neither `from` nor `to`; nothing is allocated.
  void interpolate(ConfigurationView from, ConfigurationView to, double t,
                   ConfigurationSpan q) const;

  /// One checked pair of bodies, and one that is left out with the reason.
  struct Pair {
    std::string bodyA;      ///< a robot link or an attached body
    std::string bodyB;      ///< likewise, or a world body
    bool selfPair = false;  ///< both are links or attached bodies
    double margin = 0.0;    ///< m, what they have to keep where they are checked
    /// Of a pair that is left out: `adjacent`, `SRDF: Never`, `out of reach`, `rigid`, ... Of a
    /// checked one `never` if it is proven, once for all, for all values within the joints' limits;
    /// else empty.
    std::string reason;
  };
  ///@{
  /// In a fixed order: the same for the same robot, world and rules.
  const std::vector<Pair>& checkedPairs() const;
  const std::vector<Pair>& skippedPairs() const;
  ///@}
  /// Of Robot::linksWithoutGeometry() those that the group moves: Free says nothing about them.
  std::vector<std::string> linksWithoutGeometry() const;
  /// No pair is checked, and none is proven out of reach either: Free says nothing at all.
  bool checksNothing() const;
  /// Pairs the group cannot change that are in contact: a base standing on a table, say. Checked
  /// once, here; they do not enter the verdicts.
  const std::vector<Pair>& staticContacts() const;
  /// Why a pair is checked or not, who says so, and what it has to keep: one sentence. The names
  /// may come in either order. Throws std::invalid_argument for a name that is neither a link's nor
  /// a body's.
  std::string explain(std::string_view bodyA, std::string_view bodyB) const;

 private:
  friend class Workspace;
  friend PathClearance pathClearance(const Checker&, const ConfigurationList&, double, Workspace&,
                                     ClearanceQuery);
  explicit Checker(std::shared_ptr<const detail::CheckerModel> model);
  void requireSize(std::span<const double> q) const;
  void requireSizes(std::span<const double> states, std::size_t count) const;
  detail::WorkspaceData& dataOf(Workspace& workspace) const;
  Checker version(std::shared_ptr<const World> world, CheckerOptions options) const;
  std::shared_ptr<const detail::CheckerModel> model_;
};

}  // namespace swept
