// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/schedule.hpp"

#include <algorithm>
#include <iostream>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "certificate/path_files.hpp"
#include "command_line/commands.hpp"
#include "input/constraints.hpp"
#include "input/groups.hpp"
#include "input/inputs.hpp"
#include "input/states.hpp"
#include "input/task.hpp"
#include "input/unchecked.hpp"
#include "output/progress.hpp"
#include "output/terminal_text.hpp"
#include "output/text_output.hpp"
#include "page/pages.hpp"
#include "schedule/schedule_parts.hpp"
#include "swept/ompl_bridge/schedule_plan.hpp"
#include "swept/robot_model/trajectory_file.hpp"
#include "swept/robot_model/usage_error.hpp"
#include "text/numbers.hpp"
#include "trajectory/timing.hpp"
#include "trajectory/trajectory_report.hpp"

namespace swept {
namespace {

/// The command line as it would be for the sum of the parts' groups.
Arguments ofSum(const Arguments& args, const std::vector<SchedulePart>& parts) {
  if (asksForGroup(args))
    throw UsageError(
        "the group of a schedule is that of its parts: leave out --group, --joints "
        "and --chain");
  Arguments sum = args;
  for (const SchedulePart& part : parts) sum.group += (sum.group.empty() ? "" : "+") + part.group;
  return sum;
}

/// What may happen to one part.
struct Delay {
  std::size_t part = 0;
  double latest = 0.0;   ///< s
  double percent = 0.0;  ///< slower
  DelayCertificate certificate = {};
};

std::string toleranceText(const Delay& delay) {
  return delay.percent > 0.0 ? ", at up to " + shortNumber(delay.percent) + " % slower" : "";
}

class ScheduleRun {
 public:
  explicit ScheduleRun(const Arguments& args)
      : parts_(partsOf(args)),
        args_(ofSum(args, parts_)),
        starts_(startsOf(args, parts_)),
        late_(numbersOf("--late", args.schedule.late, parts_, "S")),
        slow_(numbersOf("--slow", args.schedule.slow, parts_, "PERCENT")),
        warnings_(args.quiet),
        model_(loadModel(args_, warnings_)) {}

  ExitCode run() {
    requirePageFile(args_);
    const Group& group = chooseGroup(*model_.robot, args_);
    query_.limits = limitsOf(args_, model_, group);
    query_.clearances = true;
    checker_ = makeChecker(args_, model_, group, model_.world, warnings_);
    if (!args_.output.empty())
      file_.emplace(args_.output, *model_.robot, group, PathFile::Content::Trajectory);
    readParts();
    checker_ = withConstraintsOf(args_, checker_, startOfAll());
    if (!tasks_.empty() && !plan()) {
      printFailure();
      return ExitCode::Collision;
    }
    const CombinedCurve combined = combine();
    Progress progress("certifying", args_.quiet);
    certify(combined);
    for (Delay& delay : delays_) certify(delay);
    if (file_) write(combined.curve);
    print();
    writeTrajectoryPage(args_, model_, *checker_, shown_);
    return code_;
  }

 private:
  static std::vector<double> positionOf(const PiecewisePolynomial& curve, double time) {
    const Eigen::VectorXd q = curve.position(time);
    return {q.begin(), q.end()};
  }

  void readParts() {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (late_.contains(i) || slow_.contains(i))
        delays_.push_back({.part = i,
                           .latest = late_.contains(i) ? late_.at(i) : 0.0,
                           .percent = slow_.contains(i) ? slow_.at(i) : 0.0});
      const Group& group = chooseGroup(*model_.robot, parts_[i].group);
      if (parts_[i].isPlanned()) {
        tasks_.push_back(taskOf(args_, model_, group, parts_[i], warnings_));
        continue;
      }
      const std::vector<JointTrajectory> read =
          readTrajectories(parts_[i].file, *model_.robot, group, model_.reference, model_.options);
      if (read.size() > 1)
        throw UsageError("part '" + parts_[i].group + "=" + parts_[i].file + "': the file has " +
                         std::to_string(read.size()) + " trajectories, and a part is one");
      try {
        curves_.push_back({.variables = variableNames(*model_.robot, group),
                           .curve = controllerCurve(read.front()),
                           .start = starts_.contains(i) ? starts_.at(i) : 0.0});
      } catch (const std::invalid_argument& error) {
        throw InputError(parts_[i].file, 0, error.what());
      }
    }
  }

  /// The configuration of all groups at the clock's time 0.
  std::vector<double> startOfAll() const {
    const Group& all = checker_->group();
    std::vector<double> start(all.variables.size(), 0.0);
    const auto put = [&](const std::vector<std::string>& names, const auto& values) {
      for (std::size_t v = 0; v < names.size(); ++v) {
        const auto at = std::ranges::find(all.variables, *model_.robot->findVariable(names[v]));
        start[static_cast<std::size_t>(at - all.variables.begin())] = values[v];
      }
    };
    for (const ScheduledCurve& curve : curves_)
      put(curve.variables, positionOf(curve.curve, curve.curve.begin()));
    for (const ScheduleTask& task : tasks_)
      put(variableNames(*model_.robot, *model_.robot->findGroup(task.group)), task.start);
    return start;
  }

  static double largestOf(const std::map<std::size_t, double>& numbers) {
    double largest = 0.0;
    for (const auto& [part, number] : numbers) largest = std::max(largest, number);
    return largest;
  }

  /// Whether there is a schedule of the groups that have none yet. It leaves room for all delays
  /// and slowdowns that are asked about.
  bool plan() {
    Progress progress("planning", args_.quiet);
    try {
      plan_ = planSchedule(*checker_, tasks_, curves_, {},
                           {.seconds = args_.time,
                            .delay = largestOf(late_),
                            .slowest = 1.0 + largestOf(slow_) / 100.0,
                            .seed = args_.seed});
    } catch (const std::invalid_argument& error) {
      throw UsageError(std::string("--plan: ") + error.what());
    }
    curves_.insert(curves_.end(), plan_.curves.begin(), plan_.curves.end());
    return !plan_.curves.empty();
  }

  /// The group that has no trajectory, and why.
  std::string failureText() const {
    std::string text = tasks_[plan_.task].group + ": ";
    switch (plan_.status) {
      case PlannedSchedule::Status::StartNotFree:
        text += "the start is not free";
        break;
      case PlannedSchedule::Status::GoalNotFree:
        text += "the goal is not free, even when all others have come to rest";
        break;
      case PlannedSchedule::Status::NotFound:
        text += "no way was found in " + shortNumber(args_.time) + " s";
        break;
      case PlannedSchedule::Status::Found:
      case PlannedSchedule::Status::NotProven:
        break;
    }
    return plan_.contact ? text + ": " + witnessText(*plan_.contact) : text;
  }

  void printFailure() const {
    if (!args_.json) {
      printText("schedule      not found: " + escapedLine(failureText()) + "\n" +
                uncheckedText(*checker_));
      return;
    }
    Json json = {{"robot", model_.robot->name()},
                 {"group", checker_->group().name},
                 {"parts", partsJson()},
                 {"schedule", nullptr},
                 {"status", toString(plan_.status)},
                 {"not_found", tasks_[plan_.task].group},
                 {"contact", plan_.contact ? toJson(*plan_.contact) : Json(nullptr)}};
    addUnchecked(json, *checker_, warnings_);
    std::cout << dumped(json) << '\n';
  }

  /// Groups that share a joint cannot be combined.
  CombinedCurve combine() const {
    try {
      return combinedCurve(*model_.robot, checker_->group(), curves_);
    } catch (const std::invalid_argument& error) {
      throw UsageError(error.what());
    }
  }

  void certify(const CombinedCurve& combined) {
    report_ = TrajectoryReport{.label = "schedule",
                               .points = combined.curve.knots().size(),
                               .begin = combined.curve.begin(),
                               .end = combined.curve.end(),
                               .certificate = certifySchedule(*checker_, curves_, query_),
                               .timing = {},
                               .constraints = &checker_->options().constraints};
    code_ = worse(code_, codeOf(report_.certificate));
    std::vector<std::vector<double>> points;
    for (const double knot : combined.curve.knots())
      points.push_back(positionOf(combined.curve, knot));
    shown_.push_back({"schedule", combined.curve, query_, report_.certificate, std::move(points)});
  }

  void certify(Delay& delay) {
    delay.certificate = certifyDelays(
        *checker_, curves_,
        {.curve = delay.part, .latest = delay.latest, .slowest = 1.0 + delay.percent / 100.0});
    code_ = worse(code_, exitCodeOf(delay.certificate.verdict));
  }

  void write(const PiecewisePolynomial& curve) {
    notWritten_ = reasonNotToWrite(report_.certificate);
    if (notWritten_.empty()) notWritten_ = writeTrajectoryOf(curve);
    if (!notWritten_.empty()) code_ = worse(code_, ExitCode::Undecided);
  }

  /// Empty, or why there is no file.
  std::string writeTrajectoryOf(const PiecewisePolynomial& curve) {
    const auto trajectory =
        controllerTrajectory(curve, variableNames(*model_.robot, checker_->group()));
    if (!trajectory)
      return "no one trajectory has the curves of all parts: velocities or accelerations of one "
             "jump where those of another do not";
    const PiecewisePolynomial executed = controllerCurve(*trajectory);
    Workspace workspace(*checker_);
    const TrajectoryCertificate found = checker_->certifyTrajectory(executed, workspace, query_);
    if (found.verdict != Verdict::Free) return "no proof was found for it as one trajectory";
    PathProof proof;
    if (file_->holdsProof()) {
      proof = proofOf(*checker_, *trajectory, found);
      if (!proof.certificate.missing.empty())
        return "none was found for " + proof.certificate.missing;
    }
    file_->write(*checker_,
                 {.states = proof.path.states,
                  .segments = proof.path.segments,
                  .inputs = inputsOfPath(args_, args_.output, trajectory->points.front().positions,
                                         trajectory->points.back().positions),
                  .warnings = warnings_.unchecked(),
                  .trajectory = &*trajectory},
                 proof.certificate, args_.embed);
    return {};
  }

  static double endOf(const ScheduledCurve& part) {
    return part.start + part.slowdown * part.curve.end();
  }

  std::string partText(std::size_t i) const {
    const ScheduledCurve& part = curves_[i];
    return "  part        " + escapedLine(parts_[i].group) + ", " +
           shortNumber(part.start + part.curve.begin()) + " to " + shortNumber(endOf(part)) + " s" +
           (parts_[i].isPlanned() ? ", planned\n" : "\n");
  }

  std::string delayText(const Delay& delay) const {
    const DelayCertificate& found = delay.certificate;
    std::string text = "late          " + escapedLine(parts_[delay.part].group) + ": ";
    if (found.verdict == Verdict::Free)
      text += "free up to " + shortNumber(delay.latest) + " s" + toleranceText(delay);
    else if (found.proven)
      text += "proven up to " + shortNumber(*found.proven) + " of " + shortNumber(delay.latest) +
              " s" + toleranceText(delay);
    else
      text += "nothing is proven" + toleranceText(delay);
    if (found.contact) {
      text += "\n  conflict    ";
      if (delay.latest > 0.0) text += shortNumber(found.contact->delay) + " s late";
      if (delay.latest > 0.0 && delay.percent > 0.0) text += " and ";
      if (delay.percent > 0.0)
        text += shortNumber(100.0 * (found.contact->slowdown - 1.0)) + " % slower";
      text += ", at " + shortNumber(found.contact->contact.time) +
              " s: " + witnessText(found.contact->contact.witness);
    }
    return text + "\n";
  }

  Json delayJson(const Delay& delay) const {
    const DelayCertificate& found = delay.certificate;
    Json json = {{"group", parts_[delay.part].group},
                 {"latest", delay.latest},
                 {"percent", delay.percent},
                 {"verdict", toString(found.verdict)},
                 {"proven", found.proven ? Json(*found.proven) : Json(nullptr)},
                 {"curves", found.curves},
                 {"contact", nullptr}};
    if (found.contact)
      json["contact"] = {{"delay", found.contact->delay},
                         {"percent", 100.0 * (found.contact->slowdown - 1.0)},
                         {"time", found.contact->contact.time},
                         {"witness", toJson(found.contact->contact.witness)}};
    return json;
  }

  Json partsJson() const {
    Json parts = Json::array();
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const bool isPlanned = parts_[i].isPlanned();
      parts.push_back({{"group", parts_[i].group},
                       {"file", isPlanned ? Json(nullptr) : Json(parts_[i].file)},
                       {"planned", isPlanned},
                       {"start", isPlanned ? 0.0 : curves_[i].start}});
      if (i < curves_.size()) parts.back()["end"] = endOf(curves_[i]);
    }
    return parts;
  }

  void print() const {
    if (args_.json) {
      Json delays = Json::array();
      for (const Delay& delay : delays_) delays.push_back(delayJson(delay));
      Json json = {{"robot", model_.robot->name()},
                   {"group", checker_->group().name},
                   {"parts", partsJson()},
                   {"schedule", trajectoryJson(report_)},
                   {"delays", delays}};
      if (file_) json["trajectory_file"] = notWritten_.empty() ? Json(args_.output) : Json(nullptr);
      if (file_) json["not_written"] = notWritten_.empty() ? Json(nullptr) : Json(notWritten_);
      addUnchecked(json, *checker_, warnings_);
      std::cout << dumped(json) << '\n';
      return;
    }
    std::string text = trajectoryText(report_);
    for (std::size_t i = 0; i < parts_.size(); ++i) text += partText(i);
    for (const Delay& delay : delays_) text += delayText(delay);
    if (file_)
      text +=
          escapedLine(notWritten_.empty() ? "written to " + args_.output
                                          : "not written to " + args_.output + ": " + notWritten_) +
          "\n";
    printText(text + uncheckedText(*checker_));
  }

  const std::vector<SchedulePart> parts_;
  const Arguments args_;  ///< with the group of all parts
  const std::map<std::size_t, double> starts_, late_, slow_;
  Warnings warnings_;
  const Model model_;
  std::optional<PathFile> file_;
  TrajectoryQuery query_;
  std::shared_ptr<const Checker> checker_;
  std::vector<ScheduledCurve> curves_;  ///< of the parts, in their order: files first
  std::vector<ScheduleTask> tasks_;     ///< of those to plan
  PlannedSchedule plan_;
  std::vector<Delay> delays_;
  TrajectoryReport report_;
  std::string notWritten_;  ///< why; empty: it is
  std::vector<ShownTrajectory> shown_;
  ExitCode code_ = ExitCode::Free;
};

}  // namespace

ExitCode runSchedule(const Arguments& args) {
  if (args.embed && !args.output.ends_with(".json")) throw UsageError("--embed needs -o FILE.json");
  return ScheduleRun(args).run();
}

}  // namespace swept
