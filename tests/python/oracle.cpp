// SPDX-License-Identifier: BSD-3-Clause
// Answers of C++ for the tests of the Python package.
//   swept_python_oracle ROBOT.urdf|CELL.yaml GROUP SCENE < questions
// A question is a line of a word and numbers in hexadecimal; so is an answer, bit for bit.
#include <cstdlib>
#include <iostream>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <string>

#include "answer.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/constraint_projection.hpp"
#include "swept/robot_model/inverse_kinematics.hpp"
#include "swept/robot_model/joint_trajectory.hpp"
#include "swept/robot_model/link_motion.hpp"
#include "swept/robot_model/path_certificate.hpp"
#include "swept/robot_model/path_clearance.hpp"
#include "swept/robot_model/sphere_model.hpp"
#include "swept/robot_model/task_constraint.hpp"
#include "swept/robot_model/tool_line.hpp"
#include "swept/robot_model/work_cell.hpp"

namespace {

using swept::test::Answer;

std::shared_ptr<const swept::Robot> robotOf(const std::string& file) {
  if (file.ends_with(".yaml")) return swept::loadWorkCell(swept::WorkCell::read(file));
  return swept::Robot::load(file, swept::Robot::srdfBeside(file));
}

/// One of each kind, loose enough for random states; constraints_test.py has the same.
swept::TaskConstraint constraints() {
  swept::TaskConstraint all = swept::TaskConstraint::upright("hand", 2.0, {0.0, 0.6, 0.8});
  swept::ConstraintFrame wrist{.body = "link5"};
  wrist.body_from_frame.translation() = Eigen::Vector3d(0.0, 0.05, 0.1);
  swept::ConstraintRegion box{.size = {1.2, 1.4, std::numeric_limits<double>::infinity()}};
  box.reference_from_region.translation() = Eigen::Vector3d(0.0, 0.1, 0.4);
  const swept::ConstraintRegion ball{.type = swept::ConstraintRegion::Type::Sphere,
                                     .size = {0.7, 0.0, 0.0}};
  const swept::ConstraintRegion post{.type = swept::ConstraintRegion::Type::Cylinder,
                                     .size = {0.3, 2.0, 0.0}};
  all.positions.push_back(
      {.frame = wrist, .reference = {.body = "link1"}, .regions = {box, ball, post}});
  all.orientations.push_back({.frame = {.body = "hand"}, .tolerance = {3.0, 1.3, 4.0}});
  all.orientations.push_back(
      {.frame = {.body = "link4"},
       .reference = {.body = "link2"},
       .tolerance = {2.5, 4.0, 2.8},
       .parameterization = swept::OrientationConstraint::Parameterization::RotationVector});
  all.joints.push_back({.joint = "joint4", .position = 0.2, .above = 1.6, .below = 1.4});
  return all;
}

class Oracle {
 public:
  Oracle(const char* robot, const char* group, const char* scene)
      : robot_(robotOf(robot)),
        checker_(robot_, group, std::make_shared<const swept::World>(swept::World::load(scene))),
        workspace_(checker_) {}

  std::string answer(const std::string& question, std::span<const double> numbers) {
    Answer answer;
    const auto size = static_cast<std::size_t>(checker_.dimension());
    const swept::ConfigurationView q = numbers.first(size);
    const swept::ConfigurationView to =
        numbers.size() >= 2 * size ? swept::ConfigurationView(numbers.subspan(size, size)) : q;
    if (!(askStates(answer, question, q) || askMotions(answer, question, q, to) ||
          askMore(answer, question, q, numbers.subspan(size)) ||
          swept::test::askSchedules(answer, question, checker_, q, numbers.subspan(size)) ||
          swept::test::askRoadmaps(answer, question, checker_, q, numbers.subspan(size)) ||
          swept::test::askShapes(answer, question, checker_, numbers.subspan(size))))
      throw std::invalid_argument("no question " + question);
    return answer.str();
  }

 private:
  bool askStates(Answer& answer, const std::string& question, swept::ConfigurationView q) {
    if (question == "check_state")
      answer << toString(checker_.checkState(q, workspace_));
    else if (question == "clearance")
      answer << checker_.clearance(q, workspace_);
    else if (question == "signed_clearance")
      addSigned(answer, q);
    else if (question == "report_state")
      add(answer, checker_.reportState(q, workspace_));
    else if (question == "within_limits")
      answer << (checker_.withinLimits(q) ? "True" : "False");
    else if (question == "link_pose")
      add(answer, linkPose(*robot_, checker_.group().name, "hand", q));
    else
      return false;
    return true;
  }
  bool askMotions(Answer& answer, const std::string& question, swept::ConfigurationView q,
                  swept::ConfigurationView to) {
    if (question == "certify_motion")
      add(answer, checker_.certifyMotion(q, to, workspace_));
    else if (question == "verdict_only")
      add(answer, checker_.certifyMotion(q, to, workspace_, swept::MotionQuery::VerdictOnly));
    else if (question == "motion_clearance")
      add(answer, checker_.motionClearance(q, to, 1e-3, workspace_));
    else if (question == "path_clearance")
      add(answer, swept::pathClearance(checker_, {q, to}, 1e-3, workspace_));
    else if (question == "interpolate")
      addAll(answer, checker_.interpolate(q, to, 0.375));
    else if (question == "inverse_kinematics")
      addInverse(answer, q, to);
    else if (question == "certify_trajectory")
      addTrajectory(answer, checker_, q, to);
    else if (question == "constrained_motion")
      add(answer, constrained().certifyMotion(q, to, workspace_));
    else if (question == "constrained_trajectory")
      addTrajectory(answer, constrained(), q, to);
    else
      return false;
    return true;
  }
  /// `more`: the numbers behind those of q.
  bool askMore(Answer& answer, const std::string& question, swept::ConfigurationView q,
               std::span<const double> more) {
    if (question == "constrained_report")
      addConstrained(answer, constrained().reportState(q, workspace_));
    else if (question == "project")
      addProjected(answer, q);
    else if (question == "tool_line")
      addLine(answer, q, more);
    else if (question == "spheres")
      addSpheres(answer, static_cast<int>(more[0]), static_cast<std::uint32_t>(more[1]));
    else if (question == "outside")
      addOutside(answer, more);
    else if (question == "beside")
      addBeside(answer, q, more);
    else
      return false;
    return true;
  }
  const swept::Checker& constrained() {
    if (!constrained_) constrained_.emplace(checker_.withConstraints(constraints()));
    return *constrained_;
  }
  static void addAll(Answer& answer, std::span<const double> values) {
    for (const double value : values) answer << value;
  }
  static void addAll(Answer& answer, const Eigen::VectorXd& values) {
    for (const double value : values) answer << value;
  }
  static void add(Answer& answer, const swept::MotionCertificate& certificate) {
    answer << toString(certificate.verdict) << certificate.freeUntil;
    answer << static_cast<double>(certificate.effort.intervals)
           << static_cast<double>(certificate.effort.lanes);
    if (certificate.violation) add(answer, *certificate.violation);
    if (!certificate.witness) return;
    const swept::Witness& witness = *certificate.witness;
    answer << witness.t << witness.bodyA << witness.bodyB << witness.distance << witness.pointA
           << witness.pointB;
  }
  static void add(Answer& answer, const swept::ConstraintViolation& violation) {
    answer << violation.t << static_cast<double>(violation.kind)
           << static_cast<double>(violation.index) << violation.excess;
  }
  void addConstrained(Answer& answer, const swept::StateReport& report) {
    answer << toString(report.verdict) << (report.constraintsHold ? "True" : "False");
    for (const swept::ConstraintViolation& violation : report.violations) {
      add(answer, violation);
      answer << describe(violation, constrained().options().constraints);
    }
  }
  void addProjected(Answer& answer, swept::ConfigurationView q) {
    const swept::ConstraintProjection projection(constrained());
    swept::ConstraintProjection::Workspace workspace(projection);
    Eigen::VectorXd residuals(projection.rows());
    projection.residuals(q, residuals, workspace);
    Eigen::MatrixXd jacobian(projection.rows(), projection.degreesOfFreedom());
    projection.jacobian(q, jacobian, workspace);
    answer << projection.usedShare(q, workspace);
    addAll(answer, residuals);
    for (const double value : jacobian.reshaped<Eigen::RowMajor>()) answer << value;
    std::vector<double> found(q.begin(), q.end());
    answer << (projection.project(found, {.share = 0.4}, workspace) ? "True" : "False");
    addAll(answer, found);
  }
  /// By a displacement in the model frame; under constraints if a fourth number is not 0.
  void addLine(Answer& answer, swept::ConfigurationView q, std::span<const double> more) {
    const auto checker =
        std::make_shared<const swept::Checker>(more[3] != 0.0 ? constrained() : checker_);
    const swept::ToolLinePlanner planner(checker, {.body = "hand"});
    Eigen::Isometry3d goal = planner.pose(q);
    goal.translation() += Eigen::Vector3d(more[0], more[1], more[2]);
    const swept::ToolLine line = planner.plan(q, goal, workspace_, {.position = 2e-3});
    answer << line.length << line.turn << line.share << line.position << line.angle
           << static_cast<double>(line.solved);
    for (const std::vector<double>& point : line.wayPoints) addAll(answer, point);
    if (!line.stop) return;
    const swept::ToolLineStop& stop = *line.stop;
    answer << static_cast<double>(stop.reason) << stop.share << stop.leastSingularValue
           << stop.jointStep << describe(stop, checker->options().constraints);
  }
  std::vector<swept::PosedShape> hand() const {
    return bodyOf(robot_->links()[static_cast<std::size_t>(*robot_->findLink("hand"))]);
  }
  void addSpheres(Answer& answer, int count, std::uint32_t seed) {
    swept::EnclosingSpheresSearch search(hand(), {.pieces = 300, .restarts = 1, .seed = seed});
    const swept::EnclosingSpheres found = search.atMost(count);
    answer << found.reach << static_cast<double>(search.countFor(0.02));
    for (const swept::EnclosingSphere& sphere : found.spheres)
      answer << sphere.center << sphere.radius;
  }
  void addOutside(Answer& answer, std::span<const double> more) {
    std::vector<swept::EnclosingSphere> spheres;
    for (std::size_t i = 0; i + 3 < more.size(); i += 4)
      spheres.push_back({{more[i], more[i + 1], more[i + 2]}, more[i + 3]});
    const swept::OutsideSpheres outside = outsideSpheres(hand(), spheres);
    const swept::SphereExcess excess = sphereExcess(hand(), spheres, {.samples = 2000});
    answer << outside.lower << outside.upper << outside.point << outside.surfaceShare
           << excess.largestSeen << excess.largest << excess.mean << excess.volumeRatio;
  }
  /// While the right arm of a cell stands at `standing`.
  void addBeside(Answer& answer, swept::ConfigurationView q, std::span<const double> standing) {
    const swept::Group& right = *robot_->findGroup("right/arm");
    Eigen::VectorXd reference = robot_->defaultState();
    for (std::size_t i = 0; i < standing.size(); ++i) reference[right.variables[i]] = standing[i];
    const swept::Checker beside(robot_, checker_.group().name,
                                std::make_shared<const swept::World>(checker_.world()),
                                {.reference = reference});
    swept::Workspace workspace(beside);
    answer << toString(beside.checkState(q, workspace)) << beside.clearance(q, workspace);
  }
  void addSigned(Answer& answer, swept::ConfigurationView q) {
    std::vector<double> gradient(q.size());
    const swept::SignedClearance found = checker_.signedClearance(q, workspace_, gradient);
    answer << found.lower << found.upper << found.pointA << found.pointB << found.normal;
    addAll(answer, gradient);
  }
  static void add(Answer& answer, const swept::StateReport& report) {
    answer << toString(report.verdict) << report.clearance << report.nearestA << report.nearestB
           << report.world.clearance << report.self.clearance
           << static_cast<double>(report.contacts.size());
    for (const swept::Witness& contact : report.contacts)
      answer << contact.bodyA << contact.bodyB << contact.pointA << contact.pointB;
  }
  static void add(Answer& answer, const swept::ClearanceInterval& found) {
    answer << found.lower << found.upper << found.t << found.bodyA << found.bodyB;
  }
  static void add(Answer& answer, const Eigen::Isometry3d& pose) {
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) answer << pose.matrix()(i, j);
  }
  /// From the seed `to` to the pose at q.
  void addInverse(Answer& answer, swept::ConfigurationView q, swept::ConfigurationView to) {
    const swept::InverseKinematics kinematics(robot_, checker_.group().name, "hand");
    swept::InverseKinematics::Workspace workspace(kinematics);
    std::vector<double> found(to.begin(), to.end());
    const bool solved = kinematics.solve(kinematics.pose(q), found, {}, workspace);
    answer << (solved ? "True" : "False");
    addAll(answer, found);
  }
  /// At rest at both ends, 1 s from one to the other.
  void addTrajectory(Answer& answer, const swept::Checker& checker, swept::ConfigurationView q,
                     swept::ConfigurationView to) {
    swept::JointTrajectory trajectory;
    for (const int variable : checker_.group().variables)
      trajectory.variables.push_back(robot_->variables()[variable].name);
    const std::vector<double> rest(q.size(), 0.0);
    trajectory.points = {{0.0, {q.begin(), q.end()}, rest, {}},
                         {1.0, {to.begin(), to.end()}, rest, {}}};
    swept::TrajectoryQuery query;
    query.limits = swept::RateLimits::of(*robot_, checker_.group());
    const swept::TrajectoryCertificate found =
        checker.certifyTrajectory(controllerCurve(trajectory), workspace_, query);
    answer << toString(found.verdict) << found.freeUntil
           << static_cast<double>(found.violations.size());
    if (found.violation) {
      answer << found.violation->time;
      add(answer, found.violation->violation);
    }
    if (found.contact) answer << found.contact->time << found.contact->witness.bodyA;
  }

  std::shared_ptr<const swept::Robot> robot_;
  swept::Checker checker_;
  swept::Workspace workspace_;
  std::optional<swept::Checker> constrained_;
};

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 4) return 2;
  Oracle oracle(argv[1], argv[2], argv[3]);
  for (std::string line; std::getline(std::cin, line);) {
    std::istringstream words(line);
    std::string question, word;
    words >> question;
    std::vector<double> numbers;
    while (words >> word) numbers.push_back(std::strtod(word.c_str(), nullptr));
    std::cout << oracle.answer(question, numbers) << '\n';
  }
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 3;
}
