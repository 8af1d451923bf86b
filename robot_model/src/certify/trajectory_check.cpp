// SPDX-License-Identifier: BSD-3-Clause
#include "certify/trajectory_check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <utility>

#include "certify/motion_check.hpp"
#include "kinematics/curve_path.hpp"
#include "trajectory/curve_limits.hpp"

namespace swept::detail {

namespace {

/// Pieces of one run: it begins with eight sub-intervals, and its bounds on rates hold in all of
/// one.
constexpr std::size_t kMostPieces = 32;

constexpr double kShareOfTolerance = 0.1;
constexpr double kLeastAccuracy = 1e-5;  // m

/// The runs of a curve as paths.
class CurveRuns {
 public:
  CurveRuns(const CheckerModel& model, const PiecewisePolynomial& curve, double clock,
            WorkspaceData& workspace)
      : model_(model), curve_(curve), clock_(clock), workspace_(workspace) {}

  /// Calls visit(run, path) for each run in order, until it returns false.
  template <typename Visit>
  void forEach(const Visit& visit) const {
    const KinematicModel& kinematics = model_.kinematics;
    for (std::size_t first = 0; first < curve_.pieces();) {
      const CurveRun run = runFrom(kinematics, curve_, first, kMostPieces, workspace_.curve);
      first = run.last;
      const bool more =
          run.straight ? visit(run, StraightPath(kinematics, endOf(run, 0, workspace_.curveBegin),
                                                 endOf(run, 1, workspace_.curveEnd)))
                       : visit(run, CurvePath(kinematics, curve_, run, clock_, workspace_.curve));
      if (!more) return;
    }
  }

  /// The time at a share of a run.
  TrajectoryPlace placeOf(const CurveRun& run, double t) const {
    const double begin = curve_.knots()[run.first];
    const double end = curve_.knots()[run.last];
    TrajectoryPlace place;
    place.time = t >= 1.0 ? end : begin + t * (end - begin);
    place.piece = std::clamp(curve_.pieceAt(place.time), run.first, run.last - 1);
    return place;
  }

 private:
  /// A straight run's configuration at an end, with the time if the model has one.
  std::span<const double> endOf(const CurveRun& run, Eigen::Index end,
                                std::vector<double>& q) const {
    const auto ends = curve_.coefficients(run.first).col(end);
    q.assign(ends.begin(), ends.end());
    if (!model_.world->obstacles().empty())
      q.push_back(clock_ + curve_.knots()[run.first + static_cast<std::size_t>(end)]);
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
}

class TrajectoryCheck {
 public:
  TrajectoryCheck(const CheckerModel& model, const PiecewisePolynomial& curve,
                  const TrajectoryQuery& query, WorkspaceData& workspace)
      : model_(model),
        curve_(curve),
        query_(query),
        workspace_(workspace),
        runs_(model, curve, query.clock, workspace) {}

  TrajectoryCertificate run() {
    found_.verdict = Verdict::Free;
    found_.freeUntil = curve_.begin();
    runs_.forEach([this](const CurveRun& run, const JointPath& path) {
      add(run, path, certifyMotion(model_, path, query_.contact, workspace_));
      return found_.verdict != Verdict::Collision;
    });
    if (query_.contact == MotionQuery::VerdictOnly && found_.verdict != Verdict::Free)
      found_.freeUntil = curve_.begin();
    found_.violations = limitViolations(curve_, *model_.robot, model_.group,
                                        query_.limits ? &*query_.limits : nullptr);
    if (query_.clearances) measure();
    return std::move(found_);
  }

 private:
  void add(const CurveRun& run, const JointPath& path, MotionCertificate&& own) {
    addEffort(own.effort, found_.effort);
    const bool open = found_.verdict != Verdict::Free;  // an earlier run was left undecided
    if (!open) found_.freeUntil = runs_.placeOf(run, own.freeUntil).time;
    if (own.verdict == Verdict::Free) return;
    if (own.verdict == Verdict::Collision) {
      found_.verdict = own.verdict;
      found_.undecided.reset();
      addContact(run, path, *std::move(own.witness));
    } else if (!open) {
      found_.verdict = own.verdict;
      found_.undecided = runs_.placeOf(run, own.undecidedAt);
    }
  }

  void addContact(const CurveRun& run, const JointPath& path, Witness&& witness) {
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
    static_cast<TrajectoryPlace&>(contact) = runs_.placeOf(run, witness.t);
    countTurns(contact.time, q);
    if (!beside.empty()) beside = q;
    contact.configuration = Eigen::Map<const Eigen::VectorXd>(q.data(), curve_.dimension());
    contact.witness = std::move(witness);
    contact.witness.t = (contact.time - curve_.begin()) / curve_.duration();
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
    const double accuracy = std::max(kShareOfTolerance * model_.options.tolerance, kLeastAccuracy);
    TrajectoryClearance& world = found_.world.emplace();
    TrajectoryClearance& self = found_.self.emplace();
    runs_.forEach([&](const CurveRun& run, const JointPath& path) {
      const MotionClearance own = motionClearance(model_, path, accuracy, ClearanceQuery::ByKind,
                                                  workspace_, {world.upper, self.upper});
      addClearance(run, own.world, world);
      addClearance(run, own.self, self);
      return true;
    });
  }

  void addClearance(const CurveRun& run, const ClearanceInterval& own,
                    TrajectoryClearance& all) const {
    all.lower = std::min(all.lower, own.lower);
    if (!(own.upper < all.upper)) return;
    static_cast<TrajectoryPlace&>(all) = runs_.placeOf(run, own.t);
    all.upper = own.upper;
    all.bodyA = own.bodyA;
    all.bodyB = own.bodyB;
  }

  const CheckerModel& model_;
  const PiecewisePolynomial& curve_;
  const TrajectoryQuery& query_;
  WorkspaceData& workspace_;
  const CurveRuns runs_;
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
