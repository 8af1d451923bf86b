// SPDX-License-Identifier: BSD-3-Clause
#include "certify/trajectory_check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <utility>

#include "certify/motion_check.hpp"
#include "certify/work_limits.hpp"
#include "kinematics/chord_path.hpp"
#include "kinematics/curve_path.hpp"
#include "trajectory/curve_limits.hpp"

namespace swept::detail {

namespace {

/// Pieces of one run: it begins with eight sub-intervals, and its bounds on rates hold in all of
/// one.
constexpr std::size_t kMostPieces = 32;

/// Pieces of a curve that are certified as one path.
struct Part {
  std::size_t first = 0;
  std::size_t last = 0;          ///< one past the last piece
  const Chord* chord = nullptr;  ///< if the path is that of a chord
};

/// The parts of a curve as paths.
class CurveParts {
 public:
  CurveParts(const CheckerModel& model, const PiecewisePolynomial& curve, double clock,
             WorkspaceData& workspace)
      : model_(model), curve_(curve), clock_(clock), workspace_(workspace) {}

  /// Calls visit(part, path) for each part in order, until it returns false.
  template <typename Visit>
  void forEach(const Visit& visit) const {
    const KinematicModel& kinematics = model_.kinematics;
    bool more = true;
    for (std::size_t first = 0; first < curve_.pieces() && more;) {
      const Chord chord = chordFrom(kinematics, curve_, first, kMostPieces);
      if (chord.last > first) {
        more = visit(Part{first, chord.last, &chord},
                     ChordPath(kinematics, beginOf(first), endOf(chord.last - 1), chord.deviation));
        first = chord.last;
        continue;
      }
      const CurveRun run = runFrom(kinematics, curve_, first, kMostPieces, workspace_.curve);
      const Part part{first, run.last};
      more = run.straight
                 ? visit(part, StraightPath(kinematics, beginOf(first), endOf(run.last - 1)))
                 : visit(part, CurvePath(kinematics, curve_, run, clock_, workspace_.curve));
      first = run.last;
    }
  }

  /// The time at a share of a part.
  TrajectoryPlace placeOf(const Part& part, double t) const {
    const double begin = curve_.knots()[part.first];
    const double end = curve_.knots()[part.last];
    TrajectoryPlace place;
    if (t >= 1.0) {
      place.time = end;
    } else {
      place.time =
          part.chord == nullptr ? begin + t * (end - begin) : timeOnChord(curve_, *part.chord, t);
    }
    place.piece = std::clamp(curve_.pieceAt(place.time), part.first, part.last - 1);
    return place;
  }

 private:
  /// The configuration at an end of a piece, with the time if the model has one.
  std::span<const double> beginOf(std::size_t piece) const {
    return configurationOf(piece, 0, workspace_.curveBegin);
  }
  std::span<const double> endOf(std::size_t piece) const {
    return configurationOf(piece, 1, workspace_.curveEnd);
  }
  std::span<const double> configurationOf(std::size_t piece, std::size_t end,
                                          std::vector<double>& q) const {
    const auto own = curve_.coefficients(piece).col(end == 0 ? 0 : curve_.degree(piece));
    q.assign(own.begin(), own.end());
    if (!model_.world->obstacles().empty()) q.push_back(clock_ + curve_.knots()[piece + end]);
    return q;
  }

  const CheckerModel& model_;
  const PiecewisePolynomial& curve_;
  const double clock_;
  WorkspaceData& workspace_;
};

void addEffort(const Effort& own, Effort& all) {
  all.intervals += own.intervals;
  all.distances += own.distances;
  all.culled += own.culled;
  all.lanes += own.lanes;
  all.constrained += own.constrained;
}

class TrajectoryCheck {
 public:
  TrajectoryCheck(const CheckerModel& model, const PiecewisePolynomial& curve,
                  const TrajectoryQuery& query, WorkspaceData& workspace)
      : model_(model),
        curve_(curve),
        query_(query),
        workspace_(workspace),
        parts_(model, curve, query.clock, workspace) {}

  TrajectoryCertificate run() {
    found_.verdict = Verdict::Free;
    found_.freeUntil = curve_.begin();
    parts_.forEach([this](const Part& part, const JointPath& path) {
      add(part, path, certifyMotion(model_, path, query_.contact, workspace_));
      return !found_.contact && !found_.violation;
    });
    if (query_.contact == MotionQuery::VerdictOnly && found_.verdict != Verdict::Free)
      found_.freeUntil = curve_.begin();
    found_.violations = limitViolations(curve_, *model_.robot, model_.group,
                                        query_.limits ? &*query_.limits : nullptr);
    if (query_.clearances) measure();
    return std::move(found_);
  }

 private:
  void add(const Part& part, const JointPath& path, MotionCertificate&& own) {
    addEffort(own.effort, found_.effort);
    const bool open = found_.verdict != Verdict::Free;  // an earlier run was left undecided
    if (!open) found_.freeUntil = parts_.placeOf(part, own.freeUntil).time;
    if (own.verdict == Verdict::Free) return;
    if (own.verdict == Verdict::Collision) {
      found_.verdict = own.verdict;
      found_.undecided.reset();
      addContact(part, path, *std::move(own.witness));
    } else if (own.verdict == Verdict::Violation) {
      found_.verdict = own.verdict;
      found_.undecided.reset();
      addViolation(part, *own.violation);
    } else if (!open) {
      found_.verdict = own.verdict;
      found_.undecided = parts_.placeOf(part, own.undecidedAt);
    }
  }

  void addContact(const Part& part, const JointPath& path, Witness&& witness) {
    std::vector<double>& q = workspace_.tubeState;
    q.resize(static_cast<std::size_t>(model_.kinematics.dimension));
    path.interpolate(witness.t, q);
    std::vector<double>& beside = witness.configuration;
    // The time of moving obstacles comes last.
    const auto size = static_cast<std::size_t>(curve_.dimension());
    q.resize(size);
    if (!beside.empty()) {
      beside.resize(size);
      q = beside;
    }
    TrajectoryContact& contact = found_.contact.emplace();
    static_cast<TrajectoryPlace&>(contact) = parts_.placeOf(part, witness.t);
    countTurns(contact.time, q);
    if (!beside.empty()) beside = q;
    contact.configuration = Eigen::Map<const Eigen::VectorXd>(q.data(), curve_.dimension());
    contact.witness = std::move(witness);
    contact.witness.t = (contact.time - curve_.begin()) / curve_.duration();
  }

  void addViolation(const Part& part, const ConstraintViolation& own) {
    TrajectoryViolation& violation = found_.violation.emplace();
    static_cast<TrajectoryPlace&>(violation) = parts_.placeOf(part, own.t);
    violation.violation = own;
    violation.violation.t = (violation.time - curve_.begin()) / curve_.duration();
  }

  /// Cyclic values in the turns of the curve.
  void countTurns(double time, std::span<double> q) const {
    constexpr double kTurn = 2.0 * std::numbers::pi;
    const Eigen::VectorXd own = curve_.position(time);
    for (std::size_t i = 0; i < q.size(); ++i)
      if (model_.kinematics.cyclic[i] != 0)
        q[i] += kTurn * std::round((own[static_cast<Eigen::Index>(i)] - q[i]) / kTurn);
  }

  void measure() {
    const double accuracy = clearanceAccuracy(model_.options.tolerance);
    TrajectoryClearance& world = found_.world.emplace();
    TrajectoryClearance& self = found_.self.emplace();
    parts_.forEach([&](const Part& part, const JointPath& path) {
      const MotionClearance own = motionClearance(model_, path, accuracy, ClearanceQuery::ByKind,
                                                  workspace_, {world.upper, self.upper});
      addClearance(part, own.world, world);
      addClearance(part, own.self, self);
      return true;
    });
  }

  void addClearance(const Part& part, const ClearanceInterval& own,
                    TrajectoryClearance& all) const {
    all.lower = std::min(all.lower, own.lower);
    if (!(own.upper < all.upper)) return;
    static_cast<TrajectoryPlace&>(all) = parts_.placeOf(part, own.t);
    all.upper = own.upper;
    all.bodyA = own.bodyA;
    all.bodyB = own.bodyB;
  }

  const CheckerModel& model_;
  const PiecewisePolynomial& curve_;
  const TrajectoryQuery& query_;
  WorkspaceData& workspace_;
  const CurveParts parts_;
  TrajectoryCertificate found_;
};

}  // namespace

TrajectoryCertificate certifyTrajectory(const CheckerModel& model, const PiecewisePolynomial& curve,
                                        const TrajectoryQuery& query, WorkspaceData& workspace) {
  return TrajectoryCheck(model, curve, query, workspace).run();
}

std::string turnsFreely(const CheckerModel& model, const PiecewisePolynomial& curve) {
  for (const int index : model.group.joints) {
    const Joint& joint = model.robot->joints()[static_cast<std::size_t>(index)];
    if (joint.type != JointType::Floating) continue;
    const auto found = std::ranges::find(model.group.variables, joint.firstVariable);
    const Eigen::Index orientation = found - model.group.variables.begin() + 3;
    for (std::size_t piece = 0; piece < curve.pieces(); ++piece) {
      const auto own = curve.coefficients(piece).middleRows(orientation, 4);
      if (curve.degree(piece) > 1 && !(own.colwise() - own.col(0)).isZero(0.0)) return joint.name;
    }
  }
  return {};
}

}  // namespace swept::detail
