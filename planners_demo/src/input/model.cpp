// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "command_line/exit_code.hpp"
#include "input/attach.hpp"
#include "input/clock.hpp"
#include "input/clouds.hpp"
#include "input/load_options.hpp"
#include "input/robot_loading.hpp"
#include "input/rules.hpp"
#include "input/states.hpp"
#include "input/task.hpp"
#include "input/tracking.hpp"
#include "input/work_cells.hpp"
#include "output/progress.hpp"
#include "output/text_output.hpp"
#include "swept/robot_model/allowed_collision_matrix.hpp"
#include "swept/robot_model/did_you_mean.hpp"
#include "swept/robot_model/planning_scene.hpp"
#include "swept/robot_model/text_file.hpp"

namespace swept {
namespace {

constexpr double kLeastAccuracy = 1e-5;  // m

std::string standingContactText(const Checker& checker) {
  std::vector<std::string> pairs;
  for (const Checker::Pair& pair : checker.staticContacts())
    pairs.push_back(pair.bodyA + " - " + pair.bodyB);
  return "swept: warning: in contact whatever group '" + checker.group().name +
         "' does, and left out of the verdicts: " + joined(pairs);
}

/// What of a checker's rules a robot without an SRDF brings.
CollisionRules defaultContactsOf(const Checker& checker) {
  CollisionRules rules;
  for (const CollisionRules::Rule& rule : checker.options().rules.rules())
    if (rule.kind == CollisionRules::Kind::Allow && rule.reason == kDefaultContact)
      rules.allow(rule.bodyA, rule.bodyB, rule.reason);
  return rules;
}

/// Who asks for pairs that nothing but a default leaves out is told what else decides.
void warnOfIdleFlag(const Arguments& args, const SrdfChoice& srdf, bool sceneHasMatrix,
                    Warnings& warnings) {
  const std::string decides = isWorkCell(args)     ? args.robot
                              : !srdf.file.empty() ? srdf.file
                              : sceneHasMatrix     ? args.scene
                                                   : std::string();
  if (args.keepDefaultContacts && !decides.empty())
    warnings("swept: warning: --keep-default-contacts changes nothing: '" + decides +
             "' says which pairs are not checked");
}

}  // namespace

SrdfChoice chooseSrdf(const Arguments& args) {
  if (args.srdf == "none" || isWorkCell(args)) return {};
  if (!args.srdf.empty()) return {.file = args.srdf, .foundBesideUrdf = false};
  const std::string beside = Robot::srdfBeside(args.robot).string();
  return {.file = beside, .foundBesideUrdf = !beside.empty()};
}

bool leavesOutDefaultContacts(const Arguments& args) {
  return !args.keepDefaultContacts && !isWorkCell(args) && chooseSrdf(args).file.empty();
}

Model loadModel(const Arguments& args, Warnings& warnings) {
  LoadOptions options = loadOptionsOf(args, warnings);
  Model model;
  model.srdf = chooseSrdf(args);
  // Kept for who asks what the robot looks like: a pipe cannot be read again.
  if (isWorkCell(args)) {
    const ComposedRobot cell = composedCell(args, options);
    model.urdf = {.text = cell.urdf, .name = cell.name};
    model.robot = withAskedGroup(loadRobot(args, cell, options), args);
  } else {
    model.urdf = args.xacro ? expandedText(args)
                            : ExpandedText{.text = readTextFile(args.robot), .name = args.robot};
    model.robot = withAskedGroup(loadRobot(args, *model.urdf, model.srdf.file, options), args);
  }
  options.modelFrame = model.robot->modelFrame();
  PlanningScene scene;
  if (!args.scene.empty()) scene = PlanningScene::load(args.scene, *model.robot, options);
  World world = std::move(scene.world);
  requireClock(args, world);
  refuseClock(args, world);
  model.reference = withStanding(args, *model.robot, std::move(scene.state), options);
  addClouds(args, *model.robot, model.reference, options, world);
  model.attached = attachedBodies(args, *model.robot, options, std::move(scene.attached));
  model.weakerRules = std::move(scene.rules);
  warnOfIdleFlag(args, model.srdf, scene.hasMatrix, warnings);
  // A scene's matrix stands in place of all that nobody decided.
  if (leavesOutDefaultContacts(args) && !scene.hasMatrix) {
    DefaultContacts contacts = defaultContacts(*model.robot);
    model.weakerRules = model.weakerRules.over(contacts.always);
    model.contactsAtDefault = std::move(contacts.sometimes);
  }
  model.options = options;
  model.world = std::make_shared<const World>(std::move(world));
  return model;
}

namespace {

/// For the first name in a rule that is nobody's.
std::string nearNameInRules(const CollisionRules& rules, const Model& model, const World& world) {
  std::vector<std::string> known;
  for (const Link& link : model.robot->links()) known.push_back(link.name);
  for (const AttachedBody& body : model.attached) known.push_back(body.name);
  for (const WorldBody& body : world.bodies()) known.push_back(body.name);
  for (const MovingObstacle& body : world.obstacles()) known.push_back(body.name);
  for (const CollisionRules::Rule& rule : rules.rules())
    for (const std::string& name : {rule.bodyA, rule.bodyB})
      if (!name.empty() && name.find('*') == std::string::npos &&
          std::ranges::find(known, name) == known.end())
        return didYouMean(name, known);
  return {};
}

constexpr const char* kMakesSrdf =
    "`swept acm ROBOT.urdf -o ROBOT.srdf` makes an SRDF that says which pairs are to be left out";

/// Those of the pairs that are checked.
std::vector<std::string> checkedOf(const Checker& checker,
                                   const std::vector<std::pair<std::string, std::string>>& pairs) {
  std::vector<std::string> checked;
  for (const Checker::Pair& pair : checker.checkedPairs())
    if (pair.selfPair && std::ranges::find_if(pairs, [&](const auto& other) {
                           return std::minmax(pair.bodyA, pair.bodyB) ==
                                  std::minmax(other.first, other.second);
                         }) != pairs.end())
      checked.push_back(pair.bodyA + " - " + pair.bodyB);
  return checked;
}

/// What without an SRDF nobody has decided is said aloud, with what decides it.
void warnOfDefaultContacts(const Checker& checker, const Model& model, Warnings& warnings) {
  if (const auto checked = checkedOf(checker, model.contactsAtDefault); !checked.empty())
    warnings(
        "swept: warning: no SRDF: in contact at the default state, though not always, and "
        "checked: " +
        joined(checked) + "; --allow A,B leaves a pair out, and " + kMakesSrdf);
  const CollisionRules defaults = defaultContactsOf(checker);
  if (defaults.empty()) return;
  std::vector<std::string> pairs;
  for (const Checker::Pair& pair : checker.skippedPairs()) {
    const auto* rule = checker.options().rules.decisive(pair.bodyA, pair.bodyB);
    const auto* own = defaults.decisive(pair.bodyA, pair.bodyB);
    if (rule != nullptr && own != nullptr && rule->reason == own->reason)
      pairs.push_back(pair.bodyA + " - " + pair.bodyB);
  }
  if (pairs.empty()) return;
  warnings.ofUnchecked(
      "swept: warning: no SRDF: not checked are links that are in contact at the default state and "
      "at all others that were looked at: " +
      joined(pairs) + "; --keep-default-contacts checks them, and " + kMakesSrdf);
}

/// `alone`: nothing else goes on that shows on the terminal.
std::shared_ptr<const Checker> makeCheckerWith(
    const CollisionRules& rules, const Arguments& args, const Model& model, const Group& group,
    std::shared_ptr<const World> world, Warnings& warnings, bool alone,
    const std::optional<Eigen::VectorXd>& reference = {}) {
  if (group.variables.empty())
    throw UsageError("group '" + group.name + "' has no joint that moves");
  CheckerOptions options;
  options.margin = args.margin;
  options.selfMargin = args.selfMargin;
  options.worldMargin = args.worldMargin;
  options.tolerance = args.tolerance;
  options.rules = rules;
  options.attached = model.attached;
  options.tracking = trackingOf(args, *model.robot);
  options.reference = reference ? reference : model.reference;
  std::shared_ptr<const Checker> checker;
  const std::shared_ptr<const World> in = world;
  try {
    const std::string links = std::to_string(model.robot->links().size());
    Progress progress("building the checker of " + links + " links", args.quiet || !alone);
    checker = std::make_shared<const Checker>(model.robot, group.name, std::move(world), options);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what() + nearNameInRules(rules, model, *in));
  }
  if (!checker->staticContacts().empty()) warnings(standingContactText(*checker));
  warnOfDefaultContacts(*checker, model, warnings);
  return checker;
}

}  // namespace

std::shared_ptr<const Checker> makeChecker(const Arguments& args, const Model& model,
                                           const Group& group, std::shared_ptr<const World> world,
                                           Warnings& warnings,
                                           const std::optional<Eigen::VectorXd>& reference) {
  const CollisionRules rules = rulesOf(args);
  for (const std::string& name : idlePatterns(rules, *model.robot, model.attached, *world))
    warnings("swept: warning: a rule names '" + name +
             "', which is the name of no link, attached body or body of the world");
  for (const std::string& text : idleStanding(args, *model.robot, group))
    warnings("swept: warning: --stand '" + text + "': group '" + group.name +
             "' moves these joints itself");
  return makeCheckerWith(rules.over(model.weakerRules), args, model, group, std::move(world),
                         warnings, true, reference);
}

std::shared_ptr<const Checker> makeFirstChecker(const Arguments& args, const Model& model,
                                                const Group& group,
                                                std::shared_ptr<const World> world,
                                                Warnings& warnings) {
  const CollisionRules rules =
      rulesIn(*world, rulesOf(args).over(model.weakerRules), *model.robot, model.attached);
  return makeCheckerWith(rules, args, model, group, std::move(world), warnings, false);
}

std::shared_ptr<const Checker> makeNextChecker(const Arguments& args, const Model& model,
                                               const Checker& like,
                                               std::shared_ptr<const World> world,
                                               Warnings& warnings) {
  CollisionRules rules =
      rulesIn(*world, rulesOf(args).over(model.weakerRules), like.robot(), like.options().attached);
  auto checker = std::make_shared<const Checker>(like.withWorld(std::move(world)));
  // What it has kept of its own rules are some of these.
  if (checker->options().rules.rules().size() != rules.rules().size())
    checker = std::make_shared<const Checker>(checker->withRules(std::move(rules)));
  if (!checker->staticContacts().empty()) warnings(standingContactText(*checker));
  return checker;
}

std::shared_ptr<const Checker> makeCheckerOfGroup(const Arguments& args, const Model& model,
                                                  Warnings& warnings) {
  const auto moves = [](const Group& group) { return !group.variables.empty(); };
  if (!asksForGroup(args) && std::ranges::count_if(model.robot->groups(), moves) != 1)
    return nullptr;
  const Group& group = chooseGroup(*model.robot, args);
  return makeChecker(args, model, group, model.world, warnings);
}

double clearanceAccuracy(const Checker& checker) {
  return std::max(0.1 * checker.options().tolerance, kLeastAccuracy);
}

}  // namespace swept
