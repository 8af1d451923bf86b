// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <filesystem>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "certificate/path_files.hpp"
#include "certificate/trajectory_json.hpp"
#include "command_line/commands.hpp"
#include "input/constraints.hpp"
#include "input/groups.hpp"
#include "input/inputs.hpp"
#include "input/states.hpp"
#include "input/task.hpp"
#include "input/unchecked.hpp"
#include "output/progress.hpp"
#include "output/seconds_since.hpp"
#include "output/terminal_text.hpp"
#include "output/text_output.hpp"
#include "page/pages.hpp"
#include "swept/robot_model/proven_trajectory.hpp"
#include "swept/robot_model/trajectory_file.hpp"
#include "swept/robot_model/usage_error.hpp"
#include "trajectory/timed_trajectory.hpp"
#include "trajectory/timing.hpp"
#include "trajectory/trajectory_report.hpp"
#include "trajectory/written_form.hpp"

namespace swept {
namespace {

/// Where the robot is before a trajectory: at the state given, or where the one before ends.
std::optional<std::vector<double>> startOf(const Arguments& args, const Model& model,
                                           const Group& group, Warnings& warnings) {
  if (args.trajectory.start.empty()) return std::nullopt;
  return readState(*model.robot, group, args.trajectory.start, "--start",
                   [&](const std::string& line) { warnings(line); });
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

void requireOutput(const Arguments& args) {
  if (args.trajectory.repair && args.output.empty()) throw UsageError("--repair needs -o FILE");
  if (args.embed && std::filesystem::path(args.output).extension() != ".json")
    throw UsageError("--embed needs -o FILE.json");
}

class TrajectoryRun {
 public:
  explicit TrajectoryRun(const Arguments& args)
      : args_(args), warnings_(args.quiet), model_(loadModel(args, warnings_)) {}

  ExitCode run() {
    requirePageFile(args_);
    const Group& group = chooseGroup(*model_.robot, args_);
    query_.limits = limitsOf(args_, model_, group);
    query_.clearances = true;
    query_.clock = args_.clock.begin.value_or(0.0);
    checker_ = makeChecker(args_, model_, group, model_.world, warnings_);
    if (!args_.output.empty())
      file_.emplace(args_.output, *model_.robot, group, PathFile::Content::Trajectory);
    std::optional<std::vector<double>> start = startOf(args_, model_, group, warnings_);
    const std::vector<JointTrajectory> trajectories = readTrajectories(
        args_.trajectory.file, *model_.robot, group, model_.reference, model_.options);
    checker_ = withConstraintsOf(args_, checker_,
                                 start ? *start : trajectories.front().points.front().positions);
    requireOneClock(trajectories.size());
    if (file_ && trajectories.size() > 1)
      throw UsageError("-o writes one trajectory; '" + args_.trajectory.file + "' has " +
                       std::to_string(trajectories.size()));
    if (file_) file_->requireNames(inputsOf(trajectories.front()), *checker_);
    for (std::size_t i = 0; i < trajectories.size(); ++i) {
      examine(file_ ? writtenForm(trajectories[i], start, args_.output) : trajectories[i], start,
              trajectories.size() > 1 ? "trajectory " + std::to_string(i + 1) : std::string());
      start = trajectories[i].points.back().positions;
    }
    print();
    writeTrajectoryPage(args_, model_, *checker_, shown_);
    return code_;
  }

 private:
  Json inputsOf(const JointTrajectory& trajectory) const {
    return inputsOfPath(args_, args_.output, trajectory.points.front().positions,
                        trajectory.points.back().positions);
  }

  /// Each trajectory begins at a time 0 of its own.
  void requireOneClock(std::size_t trajectories) const {
    const std::vector<MovingObstacle>& moving = model_.world->obstacles();
    if (moving.empty() || trajectories == 1) return;
    throw UsageError("'" + args_.trajectory.file + "' has " + std::to_string(trajectories) +
                     " trajectories, each with a time 0 of its own; beside '" +
                     moving.front().name + "', which moves, one is allowed");
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
        .certificate = checker_->certifyTrajectory(curve, workspace, query_),
        .timing = {},
        .constraints = &checker_->options().constraints};
    tell(report);
    std::vector<std::vector<double>> points;
    for (const TrajectoryPoint& point : trajectory.points) points.push_back(point.positions);
    shown_.push_back({label.empty() ? "trajectory" : label, curve, query_, report.certificate,
                      std::move(points)});
    const ExitCode code = codeOf(report.certificate);
    if (args_.trajectory.repair && code != ExitCode::Free) {
      repair(curve);
      return;
    }
    code_ = worse(code_, code);
    write(trajectory, report.certificate);
  }

  void tell(const TrajectoryReport& report) {
    text_ += trajectoryText(report);
    if (!model_.world->obstacles().empty())
      text_ += "  clock       shows " + shortNumber(query_.clock) + " s at the time 0\n";
    reports_.push_back(trajectoryJson(report));
  }

  void repair(const PiecewisePolynomial& curve) {
    const RateLimits limits = timingLimits(args_, model_, checker_->group(), "--repair");
    const auto begin = std::chrono::steady_clock::now();
    RepairedTrajectory repaired;
    try {
      repaired = repairTrajectory(*checker_, curve, limits, timingOptions(args_));
    } catch (const std::invalid_argument& error) {
      throw UsageError(std::string("--repair: ") + error.what());
    }
    if (!repaired.proven) {
      sayWhyNot(repaired);
      return;
    }
    const std::size_t wayPoints = repaired.wayPoints.size();
    TimedTrajectory timed =
        timedTrajectory(*checker_, std::move(*repaired.proven), std::move(repaired.wayPoints),
                        limits, secondsSince(begin), "repaired");
    tell(timed.report);
    text_ += "  way points  " + std::to_string(wayPoints) + ", " +
             std::to_string(repaired.inserted) + " of them inserted\n";
    code_ = worse(code_, codeOf(timed.report.certificate));
    write(timed.trajectory, timed.report.certificate);
    shown_.push_back(std::move(timed.shown));
  }

  void sayWhyNot(const RepairedTrajectory& repaired) {
    text_ += "repaired: cannot be, for at " + shortNumber(repaired.place->time) + " s " +
             (repaired.contact ? "the curve itself is in contact: " + witnessText(*repaired.contact)
                               : std::string("the curve itself is too near to be proven")) +
             "\n";
    notWritten_ = "no trajectory is free";
    code_ = worse(code_, repaired.contact ? ExitCode::Collision : ExitCode::Undecided);
  }

  /// A proof that was asked for and not found is a question that stays open.
  void write(const JointTrajectory& trajectory, const TrajectoryCertificate& found) {
    if (!file_) return;
    notWritten_ = reasonNotToWrite(found);
    if (notWritten_.empty()) notWritten_ = writeProven(trajectory, found);
    if (!notWritten_.empty()) code_ = worse(code_, ExitCode::Undecided);
    text_ +=
        escapedLine(notWritten_.empty() ? "written to " + args_.output
                                        : "not written to " + args_.output + ": " + notWritten_) +
        "\n";
  }

  /// Empty, or why there is no proof and so no file.
  std::string writeProven(const JointTrajectory& trajectory, const TrajectoryCertificate& found) {
    PathProof proof;
    if (file_->holdsProof()) {
      proof = proofOf(*checker_, trajectory, found, query_.clock);
      if (!proof.certificate.missing.empty())
        return "none was found for " + proof.certificate.missing;
    }
    file_->write(*checker_,
                 {.states = proof.path.states,
                  .segments = proof.path.segments,
                  .inputs = inputsOf(trajectory),
                  .warnings = warnings_.unchecked(),
                  .trajectory = &trajectory,
                  .clock = query_.clock},
                 proof.certificate, args_.embed);
    return {};
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
                 {"tracking", trackingJson(*checker_)},
                 {"trajectories", reports_}};
    if (!model_.world->obstacles().empty()) json["clock"] = query_.clock;
    if (file_) json["trajectory_file"] = notWritten_.empty() ? Json(args_.output) : Json(nullptr);
    if (file_) json["not_written"] = notWritten_.empty() ? Json(nullptr) : Json(notWritten_);
    addUnchecked(json, *checker_, warnings_);
    std::cout << dumped(json) << '\n';
  }

  const Arguments& args_;
  Warnings warnings_;
  const Model model_;
  std::optional<PathFile> file_;
  TrajectoryQuery query_;
  std::shared_ptr<const Checker> checker_;
  std::string text_;
  Json reports_ = Json::array();
  std::string notWritten_;  ///< why; empty: it is
  std::vector<ShownTrajectory> shown_;
  ExitCode code_ = ExitCode::Free;
};

}  // namespace

ExitCode runTrajectory(const Arguments& args) {
  requireOutput(args);
  return TrajectoryRun(args).run();
}

}  // namespace swept
