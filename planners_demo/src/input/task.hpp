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
  /// Prints nothing: another process prints it.
  static Warnings none() {
    return Warnings(Taker([](const std::string&) {}));
  }
  /// A warning that is left out with --quiet.
  void operator()(const std::string& line);
  /// A warning about what an answer does not cover, though a reader may think that it does. It is
  /// printed even when warnings are to be quiet, and is repeated in unchecked().
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

/// Whether pairs of links that are always in contact are left out, if there are any: without an
/// SRDF nobody has said which pairs are to be checked.
bool leavesOutDefaultContacts(const Arguments& args);

/// What a subcommand works on: the files of the command line, read.
struct Model {
  std::shared_ptr<const Robot> robot;
  std::shared_ptr<const World> world;  ///< of --scene; empty without
  std::optional<ExpandedText> urdf;    ///< of the robot; none: it is no file's
  SrdfChoice srdf;
  std::vector<AttachedBody> attached;        ///< of --scene, then of --attach
  std::optional<Eigen::VectorXd> reference;  ///< the robot's state in --scene; empty: none
  /// The rules of --scene and, without an SRDF and without --keep-default-contacts, those for links
  /// always in contact. The rules of the command line take precedence.
  CollisionRules weakerRules;
  /// Likewise, for links in contact at the default state but not always: they are checked.
  std::vector<std::pair<std::string, std::string>> contactsAtDefault;
  LoadOptions options;  ///< how the files were read
};
/// Throws InputError or UsageError.
Model loadModel(const Arguments& args, Warnings& warnings);

/// Throws UsageError when no joint of the group moves. Warns of standing contacts. `reference`:
/// values of the variables outside the group, as in CheckerOptions.
std::shared_ptr<const Checker> makeChecker(const Arguments& args, const Model& model,
                                           const Group& group, std::shared_ptr<const World> world,
                                           Warnings& warnings,
                                           const std::optional<Eigen::VectorXd>& reference = {});
/// A checker in the first of the worlds of many problems. Leaves out rules about bodies that this
/// world does not have; they are for other worlds.
std::shared_ptr<const Checker> makeFirstChecker(const Arguments& args, const Model& model,
                                                const Group& group,
                                                std::shared_ptr<const World> world,
                                                Warnings& warnings);
/// The same in another of the worlds, with all rules about bodies that it has.
std::shared_ptr<const Checker> makeNextChecker(const Arguments& args, const Model& model,
                                               const Checker& like,
                                               std::shared_ptr<const World> world,
                                               Warnings& warnings);
/// A checker for the group on the command line, or for the only one, in the world of --scene and
/// --cloud. Null where the group is not determined: there are several, or no joint of the only one
/// moves.
std::shared_ptr<const Checker> makeCheckerOfGroup(const Arguments& args, const Model& model,
                                                  Warnings& warnings);

/// The width (m) of the interval around a least clearance: a tenth of the tolerance that decides,
/// but no less than 1e-5. Where two bodies stay equally far apart during the whole motion, the work
/// grows with the inverse of the width.
double clearanceAccuracy(const Checker& checker);

/// A configuration and its label.
struct LabelledState {
  std::string label;
  std::vector<double> q;
  std::optional<double> time = {};  ///< s, the last of `q`, where an object of the scene moves
};

/// A checker and the states to examine. The states come from the command line, a problem of a
/// problem file, or a planning request (start, then goals).
struct Task {
  std::shared_ptr<const Checker> checker;
  std::vector<LabelledState> states;
  std::optional<PlanningRequest::PoseGoal> poseGoal = {};  ///< of a request
  TaskConstraint constraints = {};                         ///< likewise, of the whole path
  bool alternatives = false;  ///< states but the first are goals, any of which will do

  /// The start of the motion to `states[i]`, i > 0: the state before, or the first state.
  const LabelledState& beginOfMotionTo(std::size_t i) const {
    return states[alternatives ? 0 : i - 1];
  }
};
Task loadTask(const Arguments& args, const Model& model, Warnings& warnings);

}  // namespace swept
