// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "command_line/arguments.hpp"
#include "input/groups.hpp"
#include "input/xacro.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/planning_request.hpp"
#include "swept/robot_model/problems.hpp"

namespace swept {

/// Warnings on stderr or to whoever takes them, each at most once. Any thread.
class Warnings {
 public:
  using Taker = std::function<void(const std::string& line)>;
  explicit Warnings(bool quiet) : quiet_(quiet) {}
  explicit Warnings(Taker taker) : quiet_(false), taker_(std::move(taker)) {}
  /// Says nothing at all: another process says it.
  static Warnings none() {
    return Warnings(Taker([](const std::string&) {}));
  }
  /// Left out where they are to be quiet.
  void operator()(const std::string& line);
  /// Of what an answer is not about, though it may be taken to be: also where they are to be quiet,
  /// and again in unchecked().
  void ofUnchecked(const std::string& line);
  std::vector<std::string> unchecked() const;

 private:
  /// Whether it is new. The mutex is held.
  bool isNew(const std::string& line);
  void give(const std::string& line) const;

  bool quiet_;
  Taker taker_;
  mutable std::mutex mutex_;
  std::vector<std::string> seen_, unchecked_;
};

/// Which SRDF is read, and why.
struct SrdfChoice {
  std::string file;  ///< empty: none
  bool foundBesideUrdf = false;
};
SrdfChoice chooseSrdf(const Arguments& args);

/// Whether pairs of links that are always in contact are left out, if there are any: without
/// an SRDF nobody has said which pairs are to be checked.
bool leavesOutDefaultContacts(const Arguments& args);

/// What a subcommand works on: the files of the command line, read.
struct Model {
  std::shared_ptr<const Robot> robot;
  std::shared_ptr<const World> world;  ///< of --scene; empty without
  std::optional<ExpandedText> urdf;    ///< of the robot; none: it is no file's
  SrdfChoice srdf;
  std::vector<AttachedBody> attached;        ///< of --scene, then of --attach
  std::optional<Eigen::VectorXd> reference;  ///< the robot's state in --scene; empty: none
  /// Those of --scene and, without an SRDF, of what is always in contact, unless
  /// --keep-default-contacts: the command line's are over them.
  CollisionRules weakerRules;
  /// Likewise, of what is in contact at the default state and not always: is checked.
  std::vector<std::pair<std::string, std::string>> contactsAtDefault;
  LoadOptions options;  ///< how the files were read
};
/// Throws InputError or UsageError.
Model loadModel(const Arguments& args, Warnings& warnings);

/// Throws UsageError when the group has nothing to move. Warns of standing contacts. `reference`:
/// of the variables outside the group, as CheckerOptions has it.
std::shared_ptr<const Checker> makeChecker(const Arguments& args, const Model& model,
                                           const Group& group, std::shared_ptr<const World> world,
                                           Warnings& warnings,
                                           const std::optional<Eigen::VectorXd>& reference = {});
/// In the first of the worlds of many problems. Of the rules those about bodies that it does not
/// have are for the others.
std::shared_ptr<const Checker> makeFirstChecker(const Arguments& args, const Model& model,
                                                const Group& group,
                                                std::shared_ptr<const World> world,
                                                Warnings& warnings);
/// The same in another of them, with all rules about bodies that it has.
std::shared_ptr<const Checker> makeNextChecker(const Arguments& args, const Model& model,
                                               const Checker& like,
                                               std::shared_ptr<const World> world,
                                               Warnings& warnings);
/// For the group asked for, or the only one, in the world of --scene and --cloud. Null without a
/// group to choose: where there are several, or the only one has nothing to move.
std::shared_ptr<const Checker> makeCheckerOfGroup(const Arguments& args, const Model& model,
                                                  Warnings& warnings);

/// m. How narrow the interval around a least clearance is: a tenth of the tolerance that decides,
/// but no less than 1e-5: where two bodies stay equally far apart all the way, the work grows with
/// the inverse.
double clearanceAccuracy(const Checker& checker);

/// A configuration and what to call it.
struct LabelledState {
  std::string label;
  std::vector<double> q;
};

/// A checker and the states to look at, from either states on the command line, or one problem of
/// a problem file, or a planning request (start, then goals).
struct Task {
  std::shared_ptr<const Checker> checker;
  std::vector<LabelledState> states;
  std::optional<PlanningRequest::PoseGoal> poseGoal = {};  ///< of a request
  bool alternatives = false;  ///< states but the first are goals, any of which will do

  /// Where the motion to `states[i]` begins, i > 0: at the state before, or at the start.
  const LabelledState& beginOfMotionTo(std::size_t i) const {
    return states[alternatives ? 0 : i - 1];
  }
};
Task loadTask(const Arguments& args, const Model& model, Warnings& warnings);

}  // namespace swept
