// SPDX-License-Identifier: BSD-3-Clause
#include "replay/query_dump.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>

#include "command_line/exit_code.hpp"
#include "input/inputs.hpp"
#include "input/state_lists.hpp"
#include "input/states.hpp"
#include "output/terminal_text.hpp"
#include "output/text_output.hpp"
#include "output/whole_file.hpp"
#include "replay/robot_cases.hpp"
#include "verify/encoding.hpp"

namespace swept {
namespace {

namespace fs = std::filesystem;

/// Of the digest in a file's name: 48 bits.
constexpr std::size_t kNameDigits = 12;

std::string folderOf(const Arguments& args) {
  if (!args.dump.empty()) return args.dump;
  const char* variable = std::getenv("SWEPT_DUMP_DIR");
  return variable == nullptr ? "" : variable;
}

}  // namespace

void addDumpOption(CLI::App& app, Arguments& args) {
  app.add_option("--dump", args.dump,
                 "folder: what is not free is written into it, a file each for 'swept replay'; "
                 "without: the folder of SWEPT_DUMP_DIR, if that is set")
      ->type_name("DIR");
}

QueryDump::QueryDump(const Arguments& args)
    : args_(args),
      folder_(folderOf(args)),
      where_((args.dump.empty() ? "SWEPT_DUMP_DIR '" : "--dump '") + folder_ + "'") {
  if (folder_.empty()) return;
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) throw UsageError("cannot make the folder '" + folder_ + "': " + error.message());
  requireWritable(fs::path(folder_) / "case.json");
  requireUtf8(inputsJson(args_, fs::path(folder_) / "case.json"), where_);
}

void QueryDump::requireNames(const Checker& checker) const {
  if (folder_.empty()) return;
  requireUtf8(checker.group().name, where_);
  for (const int v : checker.group().variables)
    requireUtf8(checker.robot().variables()[v].name, where_);
}

void QueryDump::state(const Checker& checker, const std::string& label,
                      const std::vector<double>& q, Verdict verdict) {
  MotionCertificate found;
  found.verdict = verdict;
  write(checker, label, {q}, found);
}

void QueryDump::motion(const Checker& checker, const std::string& label,
                       const std::vector<double>& from, const std::vector<double>& to,
                       const MotionCertificate& certificate) {
  write(checker, label, {from, to}, certificate);
}

void QueryDump::setFirstState(const LabelledState& state) {
  const bool asTyped =
      !args_.degrees && std::ranges::none_of(args_.states, isStateList) && args_.path.empty();
  if (asTyped) return;
  std::vector<double> q = state.q;
  if (state.time) q.pop_back();
  args_.states = {stateText(q)};
}

void QueryDump::setProblem(const std::string& set, int index) {
  args_.set = set;
  args_.index = index;
}

void QueryDump::write(const Checker& checker, const std::string& label,
                      const std::vector<std::vector<double>>& states,
                      const MotionCertificate& found) {
  if (folder_.empty() || found.verdict == Verdict::Free) return;
  requireNames(checker);
  RobotQuestion question;
  question.inputs = args_;
  for (std::vector<double> q : states) {
    if (!checker.world().obstacles().empty()) {
      question.times.push_back(q.back());
      q.pop_back();
    }
    question.states.push_back(std::move(q));
  }
  question.expected = found.verdict;
  question.inputs.group = checker.group().name;
  question.jointNames = variableNames(checker.robot(), checker.group());
  if (found.witness) {
    question.contactAfter = found.freeUntil;
    question.contactBy = found.witness->t;
  }
  const fs::path folder(folder_);
  const std::string problem =
      args_.index ? args_.set + " " + std::to_string(*args_.index) + ", " : std::string();
  const std::string text = robotCaseText(problem + label, question, folder / "case.json");
  const std::string digest = verify::digestOf(text).substr(0, kNameDigits);
  writeWholeFile(folder / ((states.size() == 2 ? "motion-" : "state-") + digest + ".json"), text);
  ++written_;
}

void QueryDump::announce() const {
  if (written_ == 0 || args_.quiet) return;
  const bool one = written_ == 1;
  printMessage("swept: wrote " + std::to_string(written_) + (one ? " query" : " queries") +
               " that " + (one ? "is" : "are") + " not free to '" + folder_ +
               "'; 'swept replay' asks " + (one ? "it" : "them") + " again");
}

}  // namespace swept
