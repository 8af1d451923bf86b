// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
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
#include "swept/robot_model/piecewise_polynomial.hpp"
#include "swept/robot_model/robot.hpp"
#include "swept/robot_model/task_constraint.hpp"
#include "swept/robot_model/tracking_tolerance.hpp"
#include "swept/robot_model/trajectory_certificate.hpp"
#include "swept/robot_model/world.hpp"

namespace swept {

class Checker;

namespace detail {
struct CheckerModel;
struct WorkspaceData;
const CheckerModel& modelOf(const Checker& checker);
}  // namespace detail

/// What is checked, the margins and tolerances, and the work allowed.
struct CheckerOptions {
  /// m. Free means that every checked pair keeps more than this, or than its margin in the rules.
  double margin = 0.0;
  /// m. A motion that keeps more than margin + tolerance everywhere is Free, never Undecided.
  double tolerance = tolerance::kMotion;
  /// Values of all of the robot's variables; those outside the group keep them (wholeStateOf() sets
  /// them by name). Default: Robot::defaultState().
  std::optional<Eigen::VectorXd> reference = {};
  /// Cap on the intervals examined per motion; a motion that needs more is Undecided. So is a
  /// motion that needs more than 64 times as many tests of a pair of shapes (beyond the first of
  /// each), or as many sub-intervals in single precision, or in which more than 2^24 pairs would
  /// have to wait for shorter intervals.
  int maxIntervals = tolerance::kMaxIntervals;
  /// Cap on the checked pairs of shapes, some 300 bytes each, and on the pairs of bodies.
  std::size_t maxPairs = 10'000'000;
  /// These rules override the SRDF and `margin`. For a pair of links the first of these decides:
  /// these rules, layer by layer; the SRDF's `<enable_collisions>`; its `<disable_collisions>` and
  /// `<disable_default_collisions>`; the default that two links which a joint connects are not
  /// checked. For an attached body: these rules, then its touch links and the link that carries it.
  CollisionRules rules = {};
  /// Bodies that links carry.
  std::vector<AttachedBody> attached = {};
  ///@{
  /// m. Used instead of `margin` for pairs of two links or attached bodies, and for pairs with the
  /// world, including moving obstacles.
  std::optional<double> selfMargin = {}, worldMargin = {};
  ///@}
  /// Free, of a state, a motion or a curve, is proven for every configuration that this allows
  /// beside it; a contact may be of one of these (Witness::configuration). Distances and clearances
  /// are those of the states and motions themselves.
  ///
  /// A motion that keeps more than its margin, `tolerance` and the tube's reach is Free. The reach
  /// is the sum over joints of their tolerance times the lever arm of the nearest point, along the
  /// direction to the other body. robot_model/README.md ("Tubes") says what a proof needs besides.
  TrackingTolerance tracking = {};
  /// Free, of a state, a motion or a curve, is proven to keep all of these at every instant, in all
  /// of the tube. Distances, clearances and reports of pairs do not ask about them.
  ///
  /// A motion that stays farther within each of them than `tolerance` (of an angle: 1e-3 rad), and
  /// than the tube's reach, is Free, but for angles about axes near the singular ones.
  TaskConstraint constraints = {};

  /// m. Margin of pairs without a rule. `selfPair`: see Witness::selfPair.
  double marginOf(bool selfPair) const {
    return (selfPair ? selfMargin : worldMargin).value_or(margin);
  }
};

/// Scratch memory for one thread. No result depends on its content. It grows when it is used with
/// another checker than before. Used with one checker, queries allocate memory only for results of
/// no fixed size: reportState(), what certifyTrajectory() lists of contacts and limits, and
/// contacts beside a motion in a tube.
class Workspace {
 public:
  /// For this checker and its versions; any other checker may use it too, see above.
  explicit Workspace(const Checker& checker);
  Workspace(Workspace&&) noexcept;
  Workspace& operator=(Workspace&&) noexcept;
  ~Workspace();

 private:
  friend class Checker;
  std::unique_ptr<detail::WorkspaceData> data_;
};

/// Validity of states and motions of one group of a robot in one world. Immutable: any number of
/// threads may use one Checker, each with its own Workspace.
///
/// A configuration has the values of the group's variables (rad, m), in any vector type (see
/// configuration.hpp). If the world has moving obstacles, one more value follows: the time on their
/// clock, in s.
///
/// The motion from q0 to q1 is q(t) = q0 + t (q1 - q0). Cyclic variables take the shorter way,
/// floating orientations slerp along the shorter arc, and mimicking joints follow. The checker
/// tests each link that the group moves, and each body attached to one, against each world body. It
/// also tests each pair of links or attached bodies whose relative pose the group changes. The
/// rules, the SRDF, or by default a joint between the two may leave a pair out: see
/// CheckerOptions::rules. Queries never throw on configurations of the right size (otherwise
/// std::invalid_argument).
///
/// A change makes a new version: `with...` and `without...` return another Checker that shares the
/// unchanged parts with this one, and is built in a fraction of the time. This one stays as it is
/// for its users.
class Checker {
 public:
  /// Throws std::invalid_argument for an unknown group; a negative or non-finite margin (of either
  /// kind) or tolerance; a reference of the wrong size, not finite or with a zero quaternion; a
  /// rule that names an unknown body; a tracking tolerance that is negative or not finite, or of a
  /// joint that the group does not move by values of its own; an attached body whose link or touch
  /// link is unknown, whose name is taken, or with a shape or pose that AttachedBody does not
  /// allow; constraints as in withConstraints(); and more pairs than CheckerOptions::maxPairs.
  Checker(std::shared_ptr<const Robot> robot, std::string_view group,
          std::shared_ptr<const World> world, const CheckerOptions& options = {});

  /// This checker in another world. Rules that name a body of the old world that is not in the new
  /// one are dropped. Throws std::invalid_argument for null, a body with the name of an attached
  /// one, and a moving obstacle with that of a link.
  Checker withWorld(std::shared_ptr<const World> world) const;
  ///@{
  /// Adds a body to the world, here of one shape. Throws as World::add and withWorld do.
  Checker withBody(WorldBody body) const;
  Checker withBody(std::string name, Shape shape, const Eigen::Isometry3d& world_from_shape) const;
  ///@}
  /// Replaces the body of the same name in the world, and keeps all rules. Use it for a deforming
  /// surface (TriangleMesh::moved) or a sensor's next cloud; planners that start now use the new
  /// version. Its time is proportional to the size of the body. Throws as World::replace does.
  Checker withReplaced(WorldBody body) const;
  /// The same with a body of one shape.
  Checker withReplaced(std::string name, Shape shape,
                       const Eigen::Isometry3d& world_from_shape) const;
  /// Adds a moving obstacle to the world: a configuration then has a time. Throws as World::add and
  /// withWorld do.
  Checker withObstacle(MovingObstacle obstacle) const;
  /// Removes a body or moving obstacle from the world. Throws std::invalid_argument for an unknown
  /// name.
  Checker withoutBody(std::string_view name) const;
  ///@{
  /// Adds an attached body, here of one shape. Throws as the constructor does.
  Checker withAttached(AttachedBody body) const;
  Checker withAttached(std::string name, std::string link, Shape shape,
                       const Eigen::Isometry3d& link_from_shape,
                       std::vector<std::string> touchLinks = {}) const;
  ///@}
  /// Removes an attached body. Throws std::invalid_argument for an unknown name.
  Checker withoutAttached(std::string_view name) const;
  /// Replaces the rules. A pair that must now keep more than in the first version, and one with a
  /// scaled body, may take more time than in a Checker made with these rules.
  Checker withRules(CollisionRules rules) const;

  /// The same checks in another tube: see CheckerOptions::tracking. It is compiled anew, which
  /// takes as long as the constructor. Throws as the constructor does.
  Checker withTracking(TrackingTolerance tracking) const;

  /// The same checks under these constraints, in place of those before. Throws
  /// std::invalid_argument for more than 64; for a link, an attached body, a joint or a variable
  /// that is unknown, a joint of several values and a component of a quaternion; for a joint's
  /// values of which none is within its limits; for a constraint without regions, a pose that is
  /// not rigid, a quaternion or an axis without direction; and for tolerances and sizes that are
  /// negative or no numbers.
  Checker withConstraints(TaskConstraint constraints) const;

  /// An attached body at its pose in a configuration, as a body of the world: the object that a
  /// gripper releases. Throws std::invalid_argument for an unknown name, and for a configuration in
  /// which no pose is known (see checkState).
  WorldBody detachedBody(std::string_view attached, ConfigurationView q) const;

  ///@{
  /// What this version checks. The references live as long as this checker.
  const Robot& robot() const;
  const World& world() const;
  const Group& group() const;
  const CheckerOptions& options() const;
  ///@}
  int dimension() const;  ///< size of a configuration of the group

  /// Verdict on a state. Free: proven. Collision: witnessed. Undecided: within rounding of the
  /// margin, not finite, or with a prismatic value more than tolerance::kLimit outside its limits
  /// (pairs out of reach within that range are not tested). Violation: of a constraint, whether in
  /// contact or not. The answer is about `q` as given, without moving it to its limits.
  Verdict checkState(ConfigurationView q, Workspace& workspace) const;
  /// The same verdicts for many states, which are consecutive in `states` or the columns of a
  /// matrix; faster than one by one. Throws std::invalid_argument unless there is one verdict for
  /// each state.
  void checkStates(PackedConfigurations states, std::span<Verdict> verdicts,
                   Workspace& workspace) const;
  /// The same on up to `threads` threads of oneTBB (0: as many as processors), with the same result
  /// for any number. It uses no more threads than the program lets oneTBB have, and does not change
  /// that limit. Returns whether all states were checked: once `stop` is requested, by any thread,
  /// it begins with none of the 128 at a time that are left, and they are Undecided.
  bool checkStates(PackedConfigurations states, std::span<Verdict> verdicts, unsigned threads = 0,
                   const std::stop_token& stop = {}) const;
  /// All violating pairs and the clearance. It measures distances where checkState only proves them
  /// large enough: tens of microseconds for an arm among a dozen bodies, more among meshes with
  /// hollows, tens to hundreds of times the time of checkState.
  StateReport reportState(ConfigurationView q, Workspace& workspace) const;
  /// m. Proven lower bound of the least distance over all checked pairs; 0 in contact or for
  /// non-finite values. Ten to twenty times the time of checkState, less than that of reportState.
  double clearance(ConfigurationView q, Workspace& workspace) const;
  /// Signed distance of the nearest checked pair, negative in contact; more work than clearance().
  /// `gradient`, if not empty, receives the derivatives of that pair's signed distance by the
  /// values of the configuration (m per rad, m per m, m per s; for a quaternion's components as
  /// scaled to unit length). It is zero if `normal` is. If several pairs are equally near, it
  /// belongs to one of them. Throws std::invalid_argument for a gradient of another size than a
  /// configuration.
  SignedClearance signedClearance(ConfigurationView q, Workspace& workspace,
                                  ConfigurationSpan gradient = {}) const;

  /// What is proven about the motion from one configuration to another. Also Undecided if an end is
  /// not finite. Limits do not matter, except those of prismatic joints (see checkState): an end
  /// slightly beyond a limit is used as given.
  /// Every query gives the same verdict.
  MotionCertificate certifyMotion(ConfigurationView from, ConfigurationView to,
                                  Workspace& workspace,
                                  MotionQuery query = MotionQuery::FirstContact) const;
  /// Certificates of many motions, which are consecutive in `from` and `to`, on up to `threads`
  /// threads, as in checkStates. They do not depend on the number of threads. Returns whether all
  /// motions were asked about: once `stop` is requested, none is begun, and the certificates that
  /// are left are new ones, Undecided. Throws std::invalid_argument unless there is one certificate
  /// for each motion.
  bool certifyMotions(PackedConfigurations from, PackedConfigurations to,
                      std::span<MotionCertificate> certificates,
                      MotionQuery query = MotionQuery::FirstContact, unsigned threads = 0,
                      const std::stop_token& stop = {}) const;
  /// What is proven about a whole curve in time, such as a controller executes: controllerCurve().
  /// It is proven as it is, pieces, corners and all, with the time of moving obstacles beside it.
  /// Values of cyclic variables go the way that their polynomials say. Where a joint has a degree
  /// of 1, and turns by half a turn at most, it gives the same verdicts as certifyMotion(). The
  /// orientation of a floating joint follows slerp() along a piece of degree 1, and must not change
  /// along others.
  ///
  /// Throws std::invalid_argument for a curve of another size than the group has variables, limits
  /// of another size, a clock that is not finite, and an orientation that changes along a piece of
  /// a higher degree than 1.
  TrajectoryCertificate certifyTrajectory(const PiecewisePolynomial& curve, Workspace& workspace,
                                          const TrajectoryQuery& query = {}) const;
  /// Least distances over a motion. For each requested kind of pairs: upper - lower <= accuracy
  /// (m), and lower >= upper / 2 while upper >= accuracy / 50, unless the cap on intervals ends the
  /// search. For a path see pathClearance().
  MotionClearance motionClearance(ConfigurationView from, ConfigurationView to, double accuracy,
                                  Workspace& workspace,
                                  ClearanceQuery query = ClearanceQuery::ByKind) const;

  /// Whether each variable is within its limits, or at most tolerance::kLimit beyond (isWithin()).
  /// False for non-finite values. If the robot must be at the limit itself, use takeToLimits()
  /// first.
  bool withinLimits(ConfigurationView q) const;
  /// The configuration at t in [0, 1] on the motion that certifyMotion checks.
  Eigen::VectorXd interpolate(ConfigurationView from, ConfigurationView to, double t) const;
  /// The same into `q`, which is neither `from` nor `to`; allocates nothing.
  void interpolate(ConfigurationView from, ConfigurationView to, double t,
                   ConfigurationSpan q) const;

  /// A checked pair of bodies, or a skipped pair with the reason.
  struct Pair {
    std::string bodyA;      ///< a robot link or an attached body
    std::string bodyB;      ///< likewise, or a world body
    bool selfPair = false;  ///< both are links or attached bodies
    double margin = 0.0;    ///< m, what they must keep if they are checked
    /// For a skipped pair: `adjacent`, `SRDF: Never`, `out of reach`, `rigid`, ... For a checked
    /// pair: `never` if it is proven, once for all values within the joints' limits; otherwise
    /// empty.
    std::string reason;
  };
  ///@{
  /// In a fixed order, which depends only on the robot, the world and the rules.
  const std::vector<Pair>& checkedPairs() const;
  const std::vector<Pair>& skippedPairs() const;
  ///@}
  /// The links of Robot::linksWithoutGeometry() that the group moves: Free says nothing about them.
  std::vector<std::string> linksWithoutGeometry() const;
  /// Whether no pair is checked, and none is proven out of reach either: Free then says nothing at
  /// all.
  bool checksNothing() const;
  /// Pairs that the group cannot change and that are in contact, such as a base standing on a
  /// table. They are checked once, when the checker is built, and do not enter the verdicts.
  const std::vector<Pair>& staticContacts() const;
  /// One sentence that says whether a pair is checked, which rule decides, and what margin it must
  /// keep. The names may come in either order. Throws std::invalid_argument for a name that is
  /// neither a link's nor a body's.
  std::string explain(std::string_view bodyA, std::string_view bodyB) const;

 private:
  friend class Workspace;
  friend const detail::CheckerModel& detail::modelOf(const Checker& checker);
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
