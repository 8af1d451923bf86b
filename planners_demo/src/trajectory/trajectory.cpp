// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "command_line/commands.hpp"
#include "input/groups.hpp"
#include "input/states.hpp"
#include "input/task.hpp"
#include "input/unchecked.hpp"
#include "output/progress.hpp"
#include "output/terminal_text.hpp"
#include "output/text_output.hpp"
#include "page/pages.hpp"
#include "swept/robot_model/proven_trajectory.hpp"
#include "swept/robot_model/trajectory_file.hpp"
#include "swept/robot_model/usage_error.hpp"
#include "trajectory/tracking.hpp"
#include "trajectory/trajectory_report.hpp"

namespace swept {
namespace {

RateLimits limitsOf(const Arguments& args, const Model& model, const Group& group) {
  if (args.trajectory.limits.empty()) return RateLimits::of(*model.robot, group);
  return RateLimits::read(args.trajectory.limits, *model.robot, group, model.options);
}

/// Those of controllers, and what the command line says instead.
TrackingTolerance trackingOf(const Arguments& args, const Robot& robot) {
  const TrackingTolerance typed =
      args.tracking.empty() ? TrackingTolerance{} : readTracking(args.tracking, robot);
  if (args.trajectory.controllers.empty()) return typed;
  TrackingTolerance tracking = readControllers(args.trajectory.controllers, robot, typed);
  tracking.rotation = typed.rotation;
  tracking.translation = typed.translation;
  for (const auto& [name, tolerance] : typed.joints) tracking.joints[name] = tolerance;
  return tracking;
}

/// Where the robot is before a trajectory: at the state given, or where the one before ends.
std::optional<std::vector<double>> startOf(const Arguments& args, const Model& model,
                                           const Group& group, Warnings& warnings) {
  if (args.trajectory.start.empty()) return std::nullopt;
  return readState(*model.robot, group, args.trajectory.start, "--start",
                   [&](const std::string& line) { warnings(line); });
}

/// Free, and within its limits.
ExitCode codeOf(const TrajectoryCertificate& found) {
  const ExitCode code = exitCodeOf(found.verdict);
  return found.violations.empty() ? code : worse(code, ExitCode::Collision);
}

PiecewisePolynomial curveOf(const JointTrajectory& trajectory,
                            const std::optional<std::vector<double>>& start,
                            const std::string& file) {
  try {
    return start ? controllerCurve(trajectory, *start) : controllerCurve(trajectory);
  } catch (const std::invalid_argument& error) {
    throw InputError(file, 0, error.what());
  }
}

class TrajectoryRun {
 public:
  explicit TrajectoryRun(const Arguments& args)
      : args_(args), warnings_(args.quiet), model_(loadModel(args, warnings_)) {}

  ExitCode run() {
    requirePageFile(args_);
    const Group& group = chooseGroup(*model_.robot, args_);
    query_.limits = limits_ = limitsOf(args_, model_, group);
    query_.clearances = true;
    checker_ = makeChecker(args_, model_, group, model_.world, warnings_, {},
                           trackingOf(args_, *model_.robot));
    requireOutput();
    std::optional<std::vector<double>> start = startOf(args_, model_, group, warnings_);
    const std::vector<JointTrajectory> trajectories = readTrajectories(
        args_.trajectory.file, *model_.robot, group, model_.reference, model_.options);
    if (args_.trajectory.repair && trajectories.size() > 1)
      throw UsageError("--repair: the file has " + std::to_string(trajectories.size()) +
                       " trajectories; it repairs files of one");
    for (std::size_t i = 0; i < trajectories.size(); ++i) {
      examine(trajectories[i], start,
              trajectories.size() > 1 ? "trajectory " + std::to_string(i + 1) : std::string());
      start = trajectories[i].points.back().positions;
    }
    print();
    writeTrajectoryPage(args_, model_, *checker_, shown_);
    return code_;
  }

 private:
  void requireOutput() const {
    if (args_.trajectory.repair == args_.output.empty())
      throw UsageError(args_.output.empty() ? "--repair needs -o FILE"
                                            : "-o is for what --repair makes");
  }

  void examine(const JointTrajectory& trajectory, const std::optional<std::vector<double>>& start,
               const std::string& label) {
    const PiecewisePolynomial curve = curveOf(trajectory, start, args_.trajectory.file);
    Progress progress("certifying", args_.quiet);
    Workspace workspace(*checker_);
    const TrajectoryReport report{
        .label = label,
        .points = trajectory.points.size(),
        .begin = curve.begin(),
        .end = curve.end(),
        .certificate = checker_->certifyTrajectory(curve, workspace, query_)};
    tell(report);
    show(label.empty() ? "trajectory" : label, trajectory, curve, report.certificate);
    const ExitCode code = codeOf(report.certificate);
    if (!args_.trajectory.repair || code == ExitCode::Free) {
      code_ = worse(code_, code);
      return;
    }
    repair(curve);
  }

  void tell(const TrajectoryReport& report) {
    text_ += trajectoryText(report);
    reports_.push_back(trajectoryJson(report));
  }

  /// On the page, with the polyline through the points.
  void show(const std::string& label, const JointTrajectory& trajectory,
            const PiecewisePolynomial& curve, const TrajectoryCertificate& certificate) {
    std::vector<std::vector<double>> points;
    for (const TrajectoryPoint& point : trajectory.points) points.push_back(point.positions);
    shown_.push_back({label, curve, query_, certificate, std::move(points)});
  }

  /// Limits of accelerations of joints that have none.
  RateLimits limitsOfRepair() const {
    RateLimits limits = limits_;
    if (args_.trajectory.maxAcceleration)
      for (double& limit : limits.acceleration)
        if (std::isinf(limit)) limit = *args_.trajectory.maxAcceleration;
    return limits;
  }

  void repair(const PiecewisePolynomial& curve) {
    RepairedTrajectory repaired;
    try {
      repaired = repairTrajectory(*checker_, curve, limitsOfRepair());
    } catch (const std::invalid_argument& error) {
      throw UsageError(std::string("--repair: ") + error.what() +
                       "; --limits and --max-acceleration give limits");
    }
    if (repaired.proven) {
      writeTrajectory(args_.output, repaired.proven->timed.trajectory, *model_.robot,
                      TrajectoryMessage::Joint);
      const TrajectoryReport report{.label = "repaired",
                                    .points = repaired.proven->timed.trajectory.points.size(),
                                    .begin = repaired.proven->timed.curve.begin(),
                                    .end = repaired.proven->timed.curve.end(),
                                    .certificate = repaired.proven->certificate};
      tell(report);
      show("repaired", repaired.proven->timed.trajectory, repaired.proven->timed.curve,
           report.certificate);
      text_ += "  way points  " + std::to_string(repaired.wayPoints.size()) + ", " +
               std::to_string(repaired.inserted) + " of them inserted; " +
               countedText(stopsOf(*repaired.proven), "stop") + "\n";
      text_ += escapedLine("written to " + args_.output) + "\n";
      code_ = worse(code_, codeOf(repaired.proven->certificate));
      return;
    }
    text_ += "repaired: cannot be, for at " + shortNumber(repaired.place->time) + " s " +
             (repaired.contact ? "the curve itself is in contact: " + witnessText(*repaired.contact)
                               : std::string("the curve itself is too near to be proven")) +
             "\n";
    code_ = worse(code_, repaired.contact ? ExitCode::Collision : ExitCode::Undecided);
  }

  static std::size_t stopsOf(const ProvenTrajectory& proven) {
    return static_cast<std::size_t>(std::ranges::count_if(
        proven.timed.corners, [](const TimedCorner& corner) { return corner.stops(); }));
  }

  void print() const {
    if (!args_.json) {
      printText(text_ + uncheckedText(*checker_));
      return;
    }
    Json json = {{"robot", model_.robot->name()},
                 {"group", checker_->group().name},
                 {"margin", args_.margin},
                 {"margin_self", checker_->options().marginOf(true)},
                 {"margin_world", checker_->options().marginOf(false)},
                 {"tolerance", args_.tolerance},
                 {"trajectories", reports_}};
    addUnchecked(json, *checker_, warnings_);
    std::cout << dumped(json) << '\n';
  }

  const Arguments& args_;
  Warnings warnings_;
  const Model model_;
  RateLimits limits_;
  TrajectoryQuery query_;
  std::shared_ptr<const Checker> checker_;
  std::string text_;
  Json reports_ = Json::array();
  std::vector<ShownTrajectory> shown_;
  ExitCode code_ = ExitCode::Free;
};

}  // namespace

ExitCode runTrajectory(const Arguments& args) {
  return TrajectoryRun(args).run();
}

}  // namespace swept
