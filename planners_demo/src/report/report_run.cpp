// SPDX-License-Identifier: BSD-3-Clause
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <functional>
#include <iterator>

#include "batch/interrupt.hpp"
#include "batch/run_key.hpp"
#include "bench/peer.hpp"
#include "command_line/commands.hpp"
#include "output/progress.hpp"
#include "planning/planning.hpp"
#include "report/course_parts.hpp"
#include "report/executed_part.hpp"
#include "report/planned_paths.hpp"
#include "report/random_motion_part.hpp"
#include "report/report_output.hpp"
#include "report/shape_parts.hpp"

namespace swept {
namespace {

/// A signal came.
struct Stopped {};

/// Coarse first, each once.
Arguments inOrder(Arguments args) {
  for (std::vector<double>* list : {&args.report.resolutions, &args.report.tolerances}) {
    std::ranges::sort(*list, std::ranges::greater());
    list->erase(std::unique(list->begin(), list->end()), list->end());
  }
  return args;
}

// Motions, or states, of a part, over all worlds; each world has at least one.
constexpr std::size_t kMostContacts = 200, kMostClearances = 10, kMostStates = 1000;
/// There is one planned path for so many motions.
constexpr std::size_t kMotionsPerPath = 20;

std::vector<ReportMethod> without(std::vector<ReportMethod> methods, Validator::Kind kind) {
  std::erase_if(methods, [&](const ReportMethod& method) { return method.kind == kind; });
  return methods;
}

/// What is true of it. Each of the two queries proves some motions that the other does not.
MotionCertificate truthOf(const Checker& checker, const ReportMotion& motion,
                          Workspace& workspace) {
  MotionCertificate truth =
      checker.certifyMotion(motion.from, motion.to, workspace, MotionQuery::VerdictOnly);
  if (truth.verdict == Verdict::Undecided)
    truth = checker.certifyMotion(motion.from, motion.to, workspace, MotionQuery::FirstContact);
  return truth;
}

/// From coarse to fine: certified, discrete and, if asked for, FCL.
std::vector<ReportMethod> reportMethods(const Arguments& args) {
  std::vector<ReportMethod> methods;
  const auto add = [&](Validator::Kind kind, const std::vector<double>& settings) {
    for (const double setting : settings) methods.push_back({.kind = kind, .setting = setting});
  };
  add(Validator::Kind::Certified, args.report.tolerances);
  add(Validator::Kind::Discrete, args.report.resolutions);
  if (!args.against.empty()) add(Validator::Kind::Fcl, args.report.resolutions);
  return methods;
}

class ReportRun {
 public:
  explicit ReportRun(const Arguments& args)
      : args_(args),
        warnings_(args.quiet),
        model_(loadModel(args, warnings_)),
        group_(chooseGroup(*model_.robot, args)),
        worlds_(reportWorlds(args, model_)),
        checkers_(args, model_, group_, warnings_),
        methods_(reportMethods(args)),
        motions_(methods_, args.passes),
        contacts_(ReportPart::FirstContact, methods_),
        clearances_(ReportPart::Clearance, without(methods_, Validator::Kind::Fcl)),
        distances_(ReportPart::Distance, certified()),
        penetrations_(ReportPart::Penetration, certified()),
        executed_(*model_.robot, group_, args.passes),
        bar_("answers", 0, answers(), args.quiet) {
    if (static_cast<std::size_t>(args.report.motions) < worlds_.size())
      throw UsageError("--motions " + std::to_string(args.report.motions) +
                       " is less than one for "
                       "each of " +
                       std::to_string(worlds_.size()) + " worlds");
  }

  ErrorReport run() {
    for (std::size_t i = 0; i < worlds_.size(); ++i) addWorld(i);
    ErrorReport report{.robot = model_.robot->name(),
                       .group = group_.name,
                       .worlds = {},
                       .world = model_.world,
                       .margin = args_.margin,
                       .selfMargin = args_.selfMargin.value_or(args_.margin),
                       .worldMargin = args_.worldMargin.value_or(args_.margin),
                       .seed = args_.seed,
                       .passes = args_.passes,
                       .counts = motions_.counts(),
                       .motions = motions_.judged(),
                       .rows = motions_.rows(),
                       .executed = executed_.found()};
    for (const LengthTally* tally : {&contacts_, &clearances_, &distances_, &penetrations_})
      std::ranges::copy(tally->rows(), std::back_inserter(report.rows));
    for (const ReportWorld& world : worlds_) report.worlds.push_back(world.name);
    return report;
  }

 private:
  std::vector<ReportMethod> certified() const {
    return without(without(methods_, Validator::Kind::Fcl), Validator::Kind::Discrete);
  }

  /// About motions.
  std::size_t answers() const {
    return static_cast<std::size_t>(args_.report.motions) * methods_.size() *
           static_cast<std::size_t>(args_.passes);
  }

  /// The first worlds have one motion more where they cannot have equally many.
  std::size_t motionsIn(std::size_t world) const {
    const auto all = static_cast<std::size_t>(args_.report.motions);
    return all / worlds_.size() + (world < all % worlds_.size() ? 1 : 0);
  }

  void tick(std::size_t count) {
    done_ += count;
    bar_.draw(done_);
    if (Interrupt::requested()) throw Stopped();
  }

  void addWorld(std::size_t place) {
    const ReportWorld& world = worlds_[place];
    const ReportCheckers checkers = checkers_.in(world.world);
    // What is random draws from the seed as soon as it is made: here, and not in the methods.
    ompl::RNG::setSeed(seedOfRun(args_.seed, static_cast<int>(place) + 1));
    RandomMotions random(world, *checkers.truth);
    Workspace workspace(*checkers.truth);
    std::vector<ReportMotion> motions;
    for (std::size_t i = 0; i < motionsIn(place); ++i) {
      motions.push_back(random.next());
      motions.back().truth = truthOf(*checkers.truth, motions.back(), workspace);
      tick(0);
    }
    askAll(world.name, checkers, motions, random);
    if (executed_.applies()) addExecuted(place, checkers);
  }

  void addExecuted(std::size_t place, const ReportCheckers& checkers) {
    const ReportTick tick = [this](std::size_t) { this->tick(0); };
    const auto all = static_cast<std::size_t>(args_.report.motions) / kMotionsPerPath;
    executed_.add(checkers,
                  plannedPaths(worlds_[place], checkers.truth, share(all),
                               seedOfRun(args_.seed, static_cast<int>(place) + 1), tick),
                  stopwatch_, tick);
  }

  void askAll(const std::string& world, const ReportCheckers& checkers,
              std::vector<ReportMotion>& motions, RandomMotions& random) {
    const Checker& truth = *checkers.truth;
    // How many questions the other parts have is known once the motions are judged.
    const ReportTick counted = [this](std::size_t count) { this->tick(count); };
    const ReportTick tick = [this](std::size_t) { this->tick(0); };
    std::vector<AskedMethod> asked = askedMethods(methods_, checkers);
    motions_.add(world, asked, truth, motions, stopwatch_, counted);
    addFirstContacts(contacts_, asked, truth, firstOf(motions, Verdict::Collision, kMostContacts),
                     args_.passes, stopwatch_, tick);
    addClearances(clearances_, asked, truth, firstOf(motions, Verdict::Free, kMostClearances),
                  stopwatch_, tick);
    addShapePairs(distances_, penetrations_, truth, random, share(kMostStates), args_.passes,
                  stopwatch_, tick);
  }

  /// Of what there is over all worlds, one world's part.
  std::size_t share(std::size_t all) const {
    return std::max<std::size_t>(1, all / worlds_.size());
  }
  /// One world's part of so many over all worlds.
  std::vector<ReportMotion> firstOf(const std::vector<ReportMotion>& motions, Verdict truth,
                                    std::size_t overAllWorlds) const {
    std::vector<ReportMotion> found;
    for (const ReportMotion& motion : motions)
      if (motion.truth.verdict == truth && found.size() < share(overAllWorlds))
        found.push_back(motion);
    return found;
  }

  const Arguments& args_;
  Warnings warnings_;
  Model model_;
  const Group& group_;
  std::vector<ReportWorld> worlds_;
  CheckerMaker checkers_;
  std::vector<ReportMethod> methods_;
  RandomMotionPart motions_;
  LengthTally contacts_, clearances_, distances_, penetrations_;
  ExecutedPart executed_;
  Stopwatch stopwatch_;
  std::size_t done_ = 0;
  ProgressBar bar_;
};

}  // namespace

ExitCode runReport(const Arguments& given) {
  const Arguments args = inOrder(given);
  requirePeer(args);
  requireReportFiles(args);
  const Interrupt interrupt;
  ErrorReport report;
  try {
    routePlannerMessages(false);
    report = ReportRun(args).run();
  } catch (const Stopped&) {
    return ExitCode::Interrupted;
  }
  writeReport(args, report);
  return ExitCode::Free;
}

}  // namespace swept
