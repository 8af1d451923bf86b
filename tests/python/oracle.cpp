// SPDX-License-Identifier: BSD-3-Clause
// Answers of C++ for the tests of the Python package.
//   swept_python_oracle ROBOT.urdf GROUP SCENE < questions
// A question is a line of a word and numbers in hexadecimal; so is an answer, bit for bit.
#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <map>
#include <sstream>
#include <string>

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/inverse_kinematics.hpp"
#include "swept/robot_model/joint_trajectory.hpp"
#include "swept/robot_model/link_motion.hpp"
#include "swept/robot_model/path_certificate.hpp"
#include "swept/robot_model/path_clearance.hpp"

namespace {

class Answer {
 public:
  Answer() { text_ << std::hexfloat; }
  Answer& operator<<(double value) {
    text_ << value << ' ';
    return *this;
  }
  Answer& operator<<(std::string_view word) {
    text_ << word << ' ';
    return *this;
  }
  Answer& operator<<(const Eigen::Vector3d& point) {
    return *this << point.x() << point.y() << point.z();
  }
  Answer& operator<<(const char* word) { return *this << std::string_view(word); }
  Answer& operator<<(const swept::BodyName& name) {
    return *this << std::string_view(name.empty() ? "None" : name.str());
  }
  std::string str() const { return text_.str(); }

 private:
  std::ostringstream text_;
};

class Oracle {
 public:
  Oracle(const char* urdf, const char* group, const char* scene)
      : robot_(swept::Robot::load(urdf, swept::Robot::srdfBeside(urdf))),
        checker_(robot_, group, std::make_shared<const swept::World>(swept::World::load(scene))),
        workspace_(checker_) {}

  std::string answer(const std::string& question, std::span<const double> numbers) {
    Answer answer;
    const auto size = static_cast<std::size_t>(checker_.dimension());
    const swept::ConfigurationView q = numbers.first(size);
    const swept::ConfigurationView to =
        numbers.size() >= 2 * size ? swept::ConfigurationView(numbers.subspan(size, size)) : q;
    if (question == "check_state")
      answer << toString(checker_.checkState(q, workspace_));
    else if (question == "certify_motion")
      add(answer, checker_.certifyMotion(q, to, workspace_));
    else if (question == "verdict_only")
      add(answer, checker_.certifyMotion(q, to, workspace_, swept::MotionQuery::VerdictOnly));
    else if (question == "clearance")
      answer << checker_.clearance(q, workspace_);
    else if (question == "signed_clearance")
      addSigned(answer, q);
    else if (question == "report_state")
      add(answer, checker_.reportState(q, workspace_));
    else if (question == "motion_clearance")
      add(answer, checker_.motionClearance(q, to, 1e-3, workspace_));
    else if (question == "path_clearance")
      add(answer, swept::pathClearance(checker_, {q, to}, 1e-3, workspace_));
    else if (question == "interpolate")
      addAll(answer, checker_.interpolate(q, to, 0.375));
    else if (question == "within_limits")
      answer << (checker_.withinLimits(q) ? "True" : "False");
    else if (question == "link_pose")
      add(answer, linkPose(*robot_, checker_.group().name, "hand", q));
    else if (question == "inverse_kinematics")
      addInverse(answer, q, to);
    else if (question == "certify_trajectory")
      addTrajectory(answer, q, to);
    else
      throw std::invalid_argument("no question " + question);
    return answer.str();
  }

 private:
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
    if (!certificate.witness) return;
    const swept::Witness& witness = *certificate.witness;
    answer << witness.t << witness.bodyA << witness.bodyB << witness.distance << witness.pointA
           << witness.pointB;
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
  void addTrajectory(Answer& answer, swept::ConfigurationView q, swept::ConfigurationView to) {
    swept::JointTrajectory trajectory;
    for (const int variable : checker_.group().variables)
      trajectory.variables.push_back(robot_->variables()[variable].name);
    const std::vector<double> rest(q.size(), 0.0);
    trajectory.points = {{0.0, {q.begin(), q.end()}, rest, {}},
                         {1.0, {to.begin(), to.end()}, rest, {}}};
    swept::TrajectoryQuery query;
    query.limits = swept::RateLimits::of(*robot_, checker_.group());
    const swept::TrajectoryCertificate found =
        checker_.certifyTrajectory(controllerCurve(trajectory), workspace_, query);
    answer << toString(found.verdict) << found.freeUntil
           << static_cast<double>(found.violations.size());
    if (found.contact) answer << found.contact->time << found.contact->witness.bodyA;
  }

  std::shared_ptr<const swept::Robot> robot_;
  swept::Checker checker_;
  swept::Workspace workspace_;
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
