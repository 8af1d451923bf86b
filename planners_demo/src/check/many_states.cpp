// SPDX-License-Identifier: BSD-3-Clause
#include "check/many_states.hpp"

#include <algorithm>
#include <iostream>
#include <span>
#include <utility>
#include <vector>

#include "check/segment_report.hpp"
#include "check/state_report.hpp"
#include "input/unchecked.hpp"
#include "output/progress.hpp"
#include "output/terminal_text.hpp"

namespace swept {
namespace {

constexpr std::size_t kMostListed = 1000;
/// States or motions between two looks at the clock.
constexpr std::size_t kBlock = 4096;

void refusePage(const Arguments& args, const Task& task) {
  if (!args.page.file.empty())
    throw UsageError("--html shows " + std::to_string(kMostListed) + " states at most; these are " +
                     std::to_string(task.states.size()));
}

/// One behind the other.
std::vector<double> valuesOf(const Task& task, std::size_t begin, std::size_t end) {
  std::vector<double> values;
  for (std::size_t i = begin; i < end; ++i)
    values.insert(values.end(), task.states[i].q.begin(), task.states[i].q.end());
  return values;
}

/// What is printed of many.
struct Answers {
  VerdictCounts counts;
  std::string text;               ///< of the first that are not free
  Json told = Json::array();      ///< likewise
  Json verdicts = Json::array();  ///< of all
};

void print(const Arguments& args, const Model& model, const Task& task, const Warnings& warnings,
           const std::string& what, Answers& answers) {
  if (!args.json) {
    printText(answers.counts.text(what) + "\n" + answers.text +
              answers.counts.furtherText(what, answers.told.size()) + uncheckedText(*task.checker));
    return;
  }
  Json json = {{"robot", model.robot->name()},
               {"group", task.checker->group().name},
               {"margin", args.margin},
               {"margin_self", task.checker->options().marginOf(true)},
               {"margin_world", task.checker->options().marginOf(false)}};
  if (what == "motion") json["tolerance"] = args.tolerance;
  answers.counts.addTo(json);
  json["verdicts"] = std::move(answers.verdicts);
  json[what == "motion" ? "segments" : "states"] = std::move(answers.told);
  addUnchecked(json, *task.checker, warnings);
  std::cout << dumped(json) << '\n';
}

}  // namespace

void VerdictCounts::add(Verdict verdict) {
  ++(verdict == Verdict::Free        ? free_
     : verdict == Verdict::Collision ? collision_
     : verdict == Verdict::Violation ? violation_
                                     : undecided_);
}

ExitCode VerdictCounts::code() const {
  if (collision_ + violation_ > 0) return ExitCode::Collision;
  return undecided_ > 0 ? ExitCode::Undecided : ExitCode::Free;
}

std::string VerdictCounts::text(const std::string& what) const {
  std::vector<std::string> parts;
  if (free_ > 0) parts.push_back(std::to_string(free_) + " free");
  if (collision_ > 0) parts.push_back(std::to_string(collision_) + " in collision");
  if (violation_ > 0) parts.push_back(std::to_string(violation_) + " off a constraint");
  if (undecided_ > 0) parts.push_back(std::to_string(undecided_) + " undecided");
  return countedText(all(), what) + ": " + joined(parts);
}

std::string VerdictCounts::furtherText(const std::string& what, std::size_t told) const {
  if (notFree() <= told) return {};
  const std::size_t further = notFree() - told;
  return "and " + countedText(further, "further " + what) + " that " +
         (further == 1 ? "is" : "are") + " not free\n";
}

void VerdictCounts::addTo(Json& json) const {
  json["count"] = all();
  json["free"] = free_;
  json["collision"] = collision_;
  json["undecided"] = undecided_;
  if (violation_ > 0) json["violation"] = violation_;
}

bool areMany(const Task& task) {
  return task.states.size() > kMostListed;
}

ExitCode checkMany(const Arguments& args, const Model& model, const Task& task, QueryDump& dump,
                   const Warnings& warnings) {
  refusePage(args, task);
  const Checker& checker = *task.checker;
  Workspace workspace(checker);
  Answers answers;
  {
    ProgressBar progress("states", 0, task.states.size(), args.quiet);
    std::vector<Verdict> verdicts;
    for (std::size_t begin = 0; begin < task.states.size(); begin += kBlock) {
      const std::size_t end = std::min(begin + kBlock, task.states.size());
      verdicts.assign(end - begin, Verdict::Undecided);
      checker.checkStates(valuesOf(task, begin, end), verdicts);
      for (std::size_t i = begin; i < end; ++i) {
        const Verdict verdict = verdicts[i - begin];
        answers.counts.add(verdict);
        if (args.json) answers.verdicts.push_back(toString(verdict));
        if (verdict == Verdict::Free) continue;
        dump.state(checker, task.states[i].label, task.states[i].q, verdict);
        if (answers.told.size() == kMostTold) continue;
        const StateReport report = checker.reportState(task.states[i].q, workspace);
        answers.text += reportText(task.states[i].label, report, checker.options().constraints);
        answers.told.push_back(reportJson(task.states[i], report, checker.options().constraints));
      }
      progress.draw(end);
    }
  }
  print(args, model, task, warnings, "state", answers);
  dump.announce();
  return answers.counts.code();
}

ExitCode moveThroughMany(const Arguments& args, const Model& model, const Task& task,
                         QueryDump& dump, const Warnings& warnings) {
  refusePage(args, task);
  const Checker& checker = *task.checker;
  const std::size_t motions = task.states.size() - 1;
  const auto dimension = static_cast<std::size_t>(checker.dimension());
  Answers answers;
  {
    ProgressBar progress("motions", 0, motions, args.quiet);
    for (std::size_t begin = 0; begin < motions; begin += kBlock) {
      const std::size_t end = std::min(begin + kBlock, motions);
      const std::vector<double> values = valuesOf(task, begin, end + 1);
      const std::span<const double> from(values.data(), (end - begin) * dimension);
      std::vector<MotionCertificate> certificates(end - begin);
      checker.certifyMotions(from, std::span(values).subspan(dimension), certificates);
      for (std::size_t i = begin; i < end; ++i) {
        const MotionCertificate& certificate = certificates[i - begin];
        answers.counts.add(certificate.verdict);
        if (args.json) answers.verdicts.push_back(toString(certificate.verdict));
        if (certificate.verdict == Verdict::Free) continue;
        const LabelledState &a = task.states[i], &b = task.states[i + 1];
        dump.motion(checker, a.label + " to " + b.label, a.q, b.q, certificate);
        if (answers.told.size() == kMostTold) continue;
        const SegmentReport report{.from = a.label,
                                   .to = b.label,
                                   .certificate = certificate,
                                   .clearance = {},
                                   .constraints = &checker.options().constraints,
                                   .times = timesBetween(a, b)};
        answers.text += segmentText(report);
        answers.told.push_back(segmentJson(report));
      }
      progress.draw(end);
    }
  }
  print(args, model, task, warnings, "motion", answers);
  dump.announce();
  return answers.counts.code();
}

}  // namespace swept
