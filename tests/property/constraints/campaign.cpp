// SPDX-License-Identifier: BSD-3-Clause
#include "campaign.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <optional>
#include <sstream>

#include "swept/core/tolerances.hpp"
#include "swept/robot_model/checker.hpp"

namespace constraints {

namespace {

using swept::Verdict;

constexpr double kStep = 1e-3;  // rad or m

/// What rounding of the robot's file, and of extended precision, may take.
Real slackOf(const Case& of) {
  const Real joints = of.constraint.joints.empty() ? 0.0L : Real(swept::tolerance::kLimit);
  return joints + 1e-13L * (of.robot.size + 10.0);
}

/// The answer about one case, with the query's FirstContact and VerdictOnly.
struct Answer {
  Verdict verdict = Verdict::Undecided;
  Verdict verdictOnly = Verdict::Undecided;
  double holdsUntil = 0.0;  ///< share of the motion
  std::optional<swept::ConstraintViolation> violation;
  int intervals = 0;
};

/// For each value of the checker's group, its index among those of the case: branches may come in
/// another order.
std::vector<int> orderOf(const Case& of, const swept::Checker& checker) {
  std::vector<int> order;
  const swept::Robot& robot = checker.robot();
  for (const int variable : checker.group().variables) {
    const swept::Joint& joint = robot.joints()[static_cast<std::size_t>(
        robot.variables()[static_cast<std::size_t>(variable)].joint)];
    const auto own = static_cast<std::size_t>(std::stoi(joint.name.substr(1)));
    order.push_back(of.robot.joints[own].first + variable - joint.firstVariable);
  }
  return order;
}

std::vector<double> ordered(const std::vector<double>& q, const std::vector<int>& order) {
  std::vector<double> own;
  for (const int i : order) own.push_back(q[static_cast<std::size_t>(i)]);
  return own;
}

swept::PiecewisePolynomial ordered(const swept::PiecewisePolynomial& curve,
                                   const std::vector<int>& order) {
  std::vector<Eigen::MatrixXd> coefficients;
  for (std::size_t piece = 0; piece < curve.pieces(); ++piece)
    coefficients.emplace_back(curve.coefficients(piece)(order, Eigen::all));
  return {curve.knots(), std::move(coefficients)};
}

Answer ask(const Case& of, const swept::Checker& checker) {
  swept::Workspace workspace(checker);
  const std::vector<int> order = orderOf(of, checker);
  Answer answer;
  if (!of.curve) {
    const std::vector<double> from = ordered(of.from, order), to = ordered(of.to, order);
    const auto found = checker.certifyMotion(from, to, workspace);
    answer.verdict = found.verdict;
    answer.holdsUntil = found.freeUntil;
    answer.violation = found.violation;
    answer.intervals = found.effort.constrained;
    answer.verdictOnly =
        checker.certifyMotion(from, to, workspace, swept::MotionQuery::VerdictOnly).verdict;
    return answer;
  }
  const swept::PiecewisePolynomial curve = ordered(*of.curve, order);
  const auto found = checker.certifyTrajectory(curve, workspace);
  answer.verdict = found.verdict;
  answer.holdsUntil = (found.freeUntil - of.curve->begin()) / of.curve->duration();
  if (found.violation) answer.violation = found.violation->violation;
  answer.intervals = found.effort.constrained;
  answer.verdictOnly =
      checker.certifyTrajectory(curve, workspace, {.contact = swept::MotionQuery::VerdictOnly})
          .verdict;
  return answer;
}

/// Every joint as far off as it may be, or somewhere in between.
void displace(const Case& of, Random& random, std::vector<Real>& q) {
  const bool corner = random.chance(0.7);
  const auto off = [&](double most) {
    return corner ? (random.chance(0.5) ? most : -most) : random.uniform(-most, most);
  };
  for (const RobotJoint& joint : of.robot.joints) {
    if (joint.first < 0) continue;
    Real* const own = q.data() + joint.first;
    switch (joint.type) {
      case Type::Prismatic:
        own[0] = std::clamp<Real>(own[0] + off(of.tracking.translation),
                                  std::min<Real>(own[0], joint.lower),
                                  std::max<Real>(own[0], joint.upper));
        break;
      case Type::Planar:
      case Type::Floating: {
        Eigen::Vector3d way = random.direction() * std::abs(off(of.tracking.translation));
        if (joint.type == Type::Planar) {
          own[2] += off(of.tracking.rotation);
          way = std::abs(off(of.tracking.translation)) *
                Eigen::Vector3d(way.x(), way.y(), 0.0).normalized();
        }
        own[0] += way.x();
        own[1] += way.y();
        if (joint.type == Type::Floating) own[2] += way.z();
        break;
      }
      case Type::Revolute:
      case Type::Continuous:
        own[0] += off(of.tracking.rotation);
        break;
      case Type::Fixed:
        break;
    }
  }
}

class CaseJudge {
 public:
  CaseJudge(const Case& of, std::size_t samples, Random& random)
      : of_(of), most_(samples), random_(random) {}

  /// Of what is shown of a motion that is not Free.
  std::string faultOfShown(CampaignReport& report) {
    std::string text = outside(1.0, report);
    return text.empty() ? text : "shown, but " + text;
  }

  std::string fault(const Answer& answer, CampaignReport& report) {
    if (answer.verdict != answer.verdictOnly) return "queries give two verdicts";
    if ((answer.verdict == Verdict::Violation) != answer.violation.has_value())
      return "a violation is there exactly where the verdict says so";
    if (answer.verdict == Verdict::Collision) return "a contact of nothing";
    if (answer.violation) {
      if (const std::string text = faultOf(*answer.violation); !text.empty()) return text;
      if (answer.holdsUntil > answer.violation->t + 1e-9) return "proven beyond the violation";
    }
    const double until = answer.verdict == Verdict::Free ? 1.0 : answer.holdsUntil;
    return until > 0.0 ? outside(until, report) : std::string();
  }

 private:
  std::string faultOf(const swept::ConstraintViolation& violation) {
    const std::vector<Real> q = of_.at(violation.t);
    Real own = 0;
    const std::size_t i = violation.index;
    using Kind = swept::ConstraintViolation::Kind;
    switch (violation.kind) {
      case Kind::Joint:
        own = excessOfJoint(of_.robot, of_.constraint.joints.at(i), q);
        break;
      case Kind::Position:
        own = excessOf(of_.robot, of_.constraint.positions.at(i), q);
        break;
      case Kind::Orientation:
        own = excessOf(of_.robot, of_.constraint.orientations.at(i), q);
        break;
      case Kind::Axis:
        own = excessOf(of_.robot, of_.constraint.axes.at(i), q);
        break;
    }
    std::ostringstream text;
    text.precision(12);
    if (!(own > 0)) text << "a violation by " << own << " at " << violation.t;
    // A time in a curve, and Euler angles near the singular one, are known to a few digits.
    if (own > 0 && !of_.curve && of_.constraint.orientations.empty() &&
        !(std::abs(own - violation.excess) < 1e-6L))
      text << "a violation by " << own << ", not " << violation.excess;
    return text.str();
  }

  std::string outside(double until, CampaignReport& report) {
    auto count = static_cast<std::size_t>(std::ceil(of_.length() / kStep)) + 1;
    if (most_ > 0) count = std::min(count, most_);
    Real largest = -std::numeric_limits<Real>::infinity();
    for (std::size_t i = 0; i <= count; ++i) {
      const Real t = until * static_cast<Real>(i) / static_cast<Real>(count);
      std::vector<Real> q = of_.at(t);
      if (of_.inTube && i % 8 != 0) displace(of_, random_, q);
      const Real found = excess(of_, q);
      ++report.samples;
      if (found > slackOf(of_)) {
        std::ostringstream text;
        text.precision(12);
        text << "off by " << found << " at " << t << ", proven until " << until;
        return text.str();
      }
      largest = std::max(largest, found);
    }
    report.near += until == 1.0 && largest > -0.1L * of_.length() ? 1 : 0;
    report.prefixes += until > 0.0 && until < 1.0 ? 1 : 0;
    return {};
  }

  const Case& of_;
  const std::size_t most_;
  Random& random_;
};

/// States: the same as a motion that stays there.
std::string stateFault(const Case& of, const swept::Checker& checker) {
  swept::Workspace workspace(checker);
  std::vector<double> q;
  for (const Real value : of.at(0.0L)) q.push_back(static_cast<double>(value));
  const std::vector<Real> exact(q.begin(), q.end());
  q = ordered(q, orderOf(of, checker));
  const Verdict verdict = checker.checkState(q, workspace);
  const Real found = excess(of, exact);
  if (verdict == Verdict::Free && found > slackOf(of)) return "a state off its constraint is free";
  if (verdict == Verdict::Violation && !(found > 0)) return "a state within its constraint is not";
  const swept::StateReport report = checker.reportState(q, workspace);
  if (report.verdict != verdict) return "report and check give two verdicts";
  std::vector<double> twice = q;
  twice.insert(twice.end(), q.begin(), q.end());
  std::vector<Verdict> verdicts(2);
  checker.checkStates(twice, verdicts, workspace);
  if (verdicts[0] != verdict || verdicts[1] != verdict) return "many states give another verdict";
  return {};
}

void count(Verdict verdict, Tally& tally) {
  ++tally.cases;
  ++(verdict == Verdict::Free        ? tally.free
     : verdict == Verdict::Violation ? tally.violated
                                     : tally.undecided);
}

bool isRelative(const swept::TaskConstraint& constraint) {
  const auto moves = [](const auto& own) { return !own.reference.body.empty(); };
  return std::ranges::any_of(constraint.positions, moves) ||
         std::ranges::any_of(constraint.orientations, moves) ||
         std::ranges::any_of(constraint.axes, moves);
}

std::string judge(const Case& of, Random& random, const CampaignOptions& campaign,
                  CampaignReport& report) {
  const auto robot = swept::Robot::parse(of.robot.urdf(), "random.urdf");
  swept::CheckerOptions options;
  options.constraints = of.constraint;
  options.tracking = of.tracking;
  const swept::Checker checker(robot, robot->groups().front().name,
                               std::make_shared<const swept::World>(), options);
  const Answer answer = ask(of, checker);
  report.intervals += static_cast<std::uint64_t>(answer.intervals);
  count(answer.verdict, report.all);
  if (of.inTube) count(answer.verdict, report.tubes);
  if (of.curve) count(answer.verdict, report.curves);
  if (isRelative(of.constraint)) count(answer.verdict, report.relative);
  count(answer.verdict, report.kinds[static_cast<std::size_t>(of.kind)]);
  CaseJudge caseJudge(of, campaign.samples, random);
  std::string fault = caseJudge.fault(answer, report);
  const auto shown =
      campaign.shows ? campaign.shows(of, checker, orderOf(of, checker)) : std::optional<bool>();
  if (shown && answer.verdict == Verdict::Free) ++(*shown ? report.shown : report.notShown);
  if (shown.value_or(false) && answer.verdict != Verdict::Free) {
    ++report.shownOfOthers;
    if (fault.empty()) fault = caseJudge.faultOfShown(report);
  }
  return fault.empty() && !of.inTube ? stateFault(of, checker) : fault;
}

std::string line(const char* name, const Tally& tally) {
  std::ostringstream text;
  text << ' ' << name << ' ' << tally.cases << " (" << tally.free << " free, " << tally.violated
       << " violated, " << tally.undecided << " undecided)";
  return text.str();
}

}  // namespace

void Tally::add(const Tally& other) {
  cases += other.cases;
  free += other.free;
  violated += other.violated;
  undecided += other.undecided;
}

void CampaignReport::add(const CampaignReport& other) {
  all.add(other.all);
  tubes.add(other.tubes);
  curves.add(other.curves);
  relative.add(other.relative);
  for (std::size_t i = 0; i < kinds.size(); ++i) kinds[i].add(other.kinds[i]);
  near += other.near;
  prefixes += other.prefixes;
  shown += other.shown;
  notShown += other.notShown;
  shownOfOthers += other.shownOfOthers;
  samples += other.samples;
  intervals += other.intervals;
  failures.insert(failures.end(), other.failures.begin(), other.failures.end());
}

CampaignReport runCampaign(const CampaignOptions& options) {
  CampaignReport report;
  for (std::uint64_t i = options.first; i < options.first + options.count; ++i) {
    std::string fault;
    try {
      const Case made = makeCase(options.seed, i);
      Random random(options.seed ^ 0x5EEDULL, i);
      fault = judge(made, random, options, report);
    } catch (const std::exception& error) {
      fault = error.what();
    }
    if (!fault.empty())
      report.failures.push_back("constraint_refute --seed " + std::to_string(options.seed) +
                                " --first " + std::to_string(i) + ": " + fault);
  }
  return report;
}

std::string summary(const CampaignReport& report) {
  static constexpr const char* kNames[] = {"joint", "box",    "sphere", "cylinder",
                                           "euler", "vector", "axis"};
  std::string text = "motions" + line("", report.all) + line("tubes", report.tubes) +
                     line("curves", report.curves) + line("relative", report.relative);
  for (int i = 0; i < kKinds; ++i)
    text += line(kNames[i], report.kinds[static_cast<std::size_t>(i)]);
  return text + " near " + std::to_string(report.near) + ", prefixes " +
         std::to_string(report.prefixes) + ", shown again " + std::to_string(report.shown) +
         " of " + std::to_string(report.shown + report.notShown) + " free and " +
         std::to_string(report.shownOfOthers) + " others, samples " +
         std::to_string(report.samples) + ", intervals " + std::to_string(report.intervals) +
         ", refuted " + std::to_string(report.failures.size());
}

}  // namespace constraints
