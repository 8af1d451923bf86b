// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/proven_graph.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "graph/body_questions.hpp"
#include "graph/body_space.hpp"
#include "graph/box_table.hpp"
#include "graph/lone_checker.hpp"
#include "graph/model_digest.hpp"
#include "graph/proven_graph_data.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/core/tolerances.hpp"
#include "text/numbers.hpp"
#include "threads/for_each_index.hpp"

namespace swept {

namespace detail {

namespace {

/// Motions that a thread asks about at a time.
constexpr std::size_t kBatch = 32;

/// rad. A cyclic value that moves by half a turn, up to rounding, may go either way.
constexpr double kHalfTurn = std::numbers::pi - 1e-9;

void requireStaticWorld(const std::shared_ptr<const Checker>& checker) {
  if (!checker) throw std::invalid_argument("ProvenGraph: the checker must not be null");
  if (checker->world().obstacles().empty()) return;
  throw std::invalid_argument("ProvenGraph: the world has the moving obstacle '" +
                              checker->world().obstacles().front().name +
                              "', beside which a motion depends on the time");
}

BodySpace spaceOf(const MotionBoxes& boxes, const LoneChecker& lone, const Checker& checker,
                  const WorldBody& body) {
  const double perMetre = tolerance::kRoundingPerJoint * (boxes.transforms() + 2.0);
  return BodySpace(body, checker.options().rules.scale(body.name), lone.margin(body), perMetre);
}

/// How questions are asked: on how many threads, and until when.
struct Asking {
  unsigned threads = 1;
  std::stop_token stop;
};

/// Calls `prove(i, workspace)` for each i below `count`, with a workspace of each thread. Returns
/// early when it is stopped.
template <typename MakeWorkspace, typename Prove>
void forEachQuestion(std::size_t count, const Asking& how, const MakeWorkspace& makeWorkspace,
                     const Prove& prove) {
  const std::size_t batches = (count + kBatch - 1) / kBatch;
  if (batches == 0) return;
  const std::size_t most = how.threads > 0 ? how.threads : 256;
  const std::size_t shares = std::min<std::size_t>(batches, most);
  forEachIndex(shares, how.threads, [&](std::size_t share) {
    auto workspace = makeWorkspace();
    for (std::size_t batch = share; batch < batches; batch += shares)
      for (std::size_t i = batch * kBatch; i < std::min((batch + 1) * kBatch, count); ++i) {
        if (how.stop.stop_requested()) return;
        prove(i, workspace);
      }
  });
}

/// The verdicts of one checker on some motions of a graph. Those that are left when it is stopped
/// stay as they are.
void ask(const ProvenGraphData& graph, const Checker& checker,
         std::span<const std::uint32_t> motions, const Asking& how, std::span<Verdict> verdicts) {
  forEachQuestion(
      motions.size(), how, [&] { return Workspace(checker); },
      [&](std::size_t i, Workspace& workspace) {
        const ProvenGraph::Motion& motion = graph.motions[motions[i]];
        verdicts[i] = checker
                          .certifyMotion(graph.state(motion.from), graph.state(motion.to),
                                         workspace, MotionQuery::VerdictOnly)
                          .verdict;
      });
}

}  // namespace

std::uint32_t ProvenGraphData::numberOf(const std::string& name) {
  const auto number = static_cast<std::uint32_t>(std::ranges::find(names, name) - names.begin());
  if (number == names.size()) names.push_back(name);
  return number;
}

}  // namespace detail

namespace {

using detail::Asking;
using detail::BodyQuestions;
using detail::BodySpace;
using detail::LoneChecker;
using detail::MotionBlock;
using detail::MotionBoxes;
using detail::ProvenGraphData;
using detail::TouchedPiece;

/// A body of more parts is asked about by a checker that has a tree of them.
constexpr std::size_t kMostParts = 24;

/// What is known of some motions and one body.
struct BodyAnswer {
  std::vector<std::uint32_t> asked;
  std::vector<Verdict> verdicts;
};

/// Of the motions that are wanted, behind the first `first`.
BodyAnswer askBody(const ProvenGraphData& graph, const Checker& checker, const LoneChecker& lone,
                   const WorldBody& body, std::size_t first, std::span<const char> isWanted,
                   const Asking& how) {
  const BodySpace space = detail::spaceOf(*graph.boxesOf, lone, checker, body);
  std::vector<TouchedPiece> touched = graph.table.touching(space, first);
  if (!isWanted.empty())
    std::erase_if(touched, [&](const TouchedPiece& piece) { return isWanted[piece.motion] == 0; });
  BodyAnswer answer;
  std::vector<std::size_t> firstOf;  // of each motion that is asked about, and one more
  for (std::size_t i = 0; i < touched.size(); ++i)
    if (i == 0 || touched[i].motion != touched[i - 1].motion) {
      answer.asked.push_back(touched[i].motion);
      firstOf.push_back(i);
    }
  firstOf.push_back(touched.size());
  answer.verdicts.resize(answer.asked.size());
  if (answer.asked.empty()) return answer;
  if (body.parts.size() > kMostParts) {
    detail::ask(graph, lone.with(body), answer.asked, how, answer.verdicts);
    return answer;
  }
  const BodyQuestions questions(checker, *graph.boxesOf, body.name);
  detail::forEachQuestion(
      answer.asked.size(), how, [&] { return questions.workspace(); },
      [&](std::size_t i, detail::WorkspaceData& workspace) {
        const ProvenGraph::Motion& motion = graph.motions[answer.asked[i]];
        answer.verdicts[i] = questions.ask(
            graph.state(motion.from), graph.state(motion.to),
            std::span(touched).subspan(firstOf[i], firstOf[i + 1] - firstOf[i]), workspace);
      });
  return answer;
}

void takeBlocks(const BodyAnswer& answer, std::uint32_t body, ProvenGraphData& graph) {
  for (std::size_t i = 0; i < answer.asked.size(); ++i)
    if (answer.verdicts[i] != Verdict::Free)
      graph.blocks[answer.asked[i]].push_back({body, answer.verdicts[i]});
}

/// Of a motion to itself backwards: not where a cyclic value moves by half a turn.
bool isReversible(const Checker& checker, std::span<const double> from,
                  std::span<const double> to) {
  for (std::size_t i = 0; i < from.size(); ++i) {
    const auto variable = static_cast<std::size_t>(checker.group().variables[i]);
    if (!checker.robot().variables()[variable].cyclic) continue;
    const double turn = std::remainder(to[i] - from[i], 2.0 * std::numbers::pi);
    if (!(std::abs(turn) < detail::kHalfTurn)) return false;
  }
  return true;
}

std::vector<std::uint32_t> firstNumbers(std::size_t first, std::size_t last) {
  std::vector<std::uint32_t> numbers;
  for (std::size_t i = first; i < last; ++i) numbers.push_back(static_cast<std::uint32_t>(i));
  return numbers;
}

}  // namespace

ProvenGraph::ProvenGraph(std::shared_ptr<const Checker> checker) {
  detail::requireStaticWorld(checker);
  auto boxes = inDefaultEnvironment([&] { return std::make_shared<const MotionBoxes>(*checker); });
  data_ = std::make_unique<ProvenGraphData>(std::move(checker), std::move(boxes));
}

ProvenGraph::ProvenGraph(const ProvenGraph& other)
    : data_(std::make_unique<ProvenGraphData>(*other.data_)) {}
ProvenGraph& ProvenGraph::operator=(const ProvenGraph& other) {
  if (this != &other) *data_ = *other.data_;
  return *this;
}
ProvenGraph::ProvenGraph(ProvenGraph&&) noexcept = default;
ProvenGraph& ProvenGraph::operator=(ProvenGraph&&) noexcept = default;
ProvenGraph::~ProvenGraph() = default;

const std::shared_ptr<const Checker>& ProvenGraph::checker() const {
  return data_->checker;
}
std::size_t ProvenGraph::states() const {
  return data_->stateCount;
}
std::size_t ProvenGraph::motions() const {
  return data_->motions.size();
}
ConfigurationView ProvenGraph::state(std::size_t index) const {
  return data_->state(index);
}
const ProvenGraph::Motion& ProvenGraph::motion(std::size_t index) const {
  return data_->motions[index];
}
bool ProvenGraph::isFree(std::size_t motion) const {
  return data_->blocks[motion].empty();
}

Verdict ProvenGraph::verdict(std::size_t motion) const {
  const std::vector<MotionBlock>& blocks = data_->blocks[motion];
  if (blocks.empty()) return Verdict::Free;
  const bool meets = std::ranges::any_of(
      blocks, [](const MotionBlock& block) { return block.verdict == Verdict::Collision; });
  return meets ? Verdict::Collision : Verdict::Undecided;
}

std::vector<std::string> ProvenGraph::blockedBy(std::size_t motion) const {
  std::vector<std::string> names;
  for (const MotionBlock& block : data_->blocks[motion]) names.push_back(data_->names[block.body]);
  return names;
}

std::uint32_t ProvenGraph::addState(ConfigurationView q) {
  const auto dimension = static_cast<std::size_t>(data_->checker->dimension());
  if (q.size() != dimension)
    throw std::invalid_argument("ProvenGraph: a state has " + std::to_string(q.size()) +
                                " values; a configuration of group '" +
                                data_->checker->group().name + "' has " +
                                std::to_string(dimension));
  for (std::size_t i = 0; i < dimension; ++i)
    if (!std::isfinite(q[i]))
      throw std::invalid_argument("ProvenGraph: value " + std::to_string(i) + " of a state is " +
                                  detail::formatNumber(q[i]) + ", which must be finite");
  data_->values.insert(data_->values.end(), q.begin(), q.end());
  return static_cast<std::uint32_t>(data_->stateCount++);
}

std::size_t ProvenGraph::addMotions(std::span<const Motion> motions, unsigned threads,
                                    const std::stop_token& stop) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return addMotions(motions, threads, stop); });
  }
  const Asking how{threads, stop};
  ProvenGraphData& graph = *data_;
  const Checker& checker = *graph.checker;
  for (const Motion& motion : motions)
    if (motion.from >= graph.stateCount || motion.to >= graph.stateCount)
      throw std::invalid_argument("ProvenGraph: a motion from state " +
                                  std::to_string(motion.from) + " to " + std::to_string(motion.to) +
                                  "; there are " + std::to_string(graph.stateCount) + " states");
  const LoneChecker lone(checker);
  // All are put behind the others, and those that stay are moved to where they belong.
  const std::size_t before = graph.motions.size();
  for (const Motion& motion : motions)
    if (isReversible(checker, graph.state(motion.from), graph.state(motion.to)))
      graph.motions.push_back(motion);
  const std::vector<std::uint32_t> all = firstNumbers(before, graph.motions.size());
  std::vector<Verdict> verdicts(all.size());
  detail::ask(graph, checker, all, how, verdicts);
  std::vector<std::uint32_t> open;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (verdicts[i] != Verdict::Free) open.push_back(all[i]);
  std::vector<Verdict> alone(open.size());
  detail::ask(graph, checker.withWorld(std::make_shared<const World>()), open, how, alone);
  std::vector<char> stays(graph.motions.size(), 1);
  for (std::size_t i = 0; i < open.size(); ++i) stays[open[i]] = alone[i] == Verdict::Free;
  std::vector<char> isOpen(graph.motions.size(), 0);
  for (const std::uint32_t motion : open) isOpen[motion] = 1;
  open.clear();
  std::size_t kept = before;
  for (std::size_t i = before; i < graph.motions.size(); ++i) {
    if (stays[i] == 0) continue;
    if (isOpen[i] != 0) open.push_back(static_cast<std::uint32_t>(kept));
    graph.motions[kept++] = graph.motions[i];
  }
  graph.motions.resize(kept);
  graph.blocks.resize(kept);

  graph.findBoxes(before, threads);
  std::vector<char> wanted(kept, 0);
  for (const std::uint32_t motion : open) wanted[motion] = 1;
  for (const WorldBody& body : checker.world().bodies())
    takeBlocks(askBody(graph, checker, lone, body, before, wanted, how), graph.numberOf(body.name),
               graph);
  return kept - before;
}

ProvenGraph::Change ProvenGraph::update(std::shared_ptr<const Checker> changed, unsigned threads,
                                        const std::stop_token& stop) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return update(std::move(changed), threads, stop); });
  }
  detail::requireStaticWorld(changed);
  ProvenGraphData& graph = *data_;
  const Checker& checker = *graph.checker;
  if (&changed->robot() != &checker.robot() || changed->group().name != checker.group().name)
    throw std::invalid_argument(
        "ProvenGraph: the checker is of group '" + changed->group().name + "' of robot '" +
        changed->robot().name() + "'; the motions are of group '" + checker.group().name +
        "' of the robot '" + checker.robot().name() + "' that was loaded before");
  Change change;
  if (detail::questionDigest(*changed) != detail::questionDigest(checker)) {
    change.everything = true;
    ProvenGraph again(changed);
    again.data_->values = graph.values;
    again.data_->stateCount = graph.stateCount;
    again.addMotions(graph.motions, threads, stop);
    if (stop.stop_requested()) return {.stopped = true};
    change.bodiesGone = checker.world().bodies().size();
    change.bodiesNew = changed->world().bodies().size();
    change.asked = change.motionsAsked = graph.motions.size();
    *this = std::move(again);
    return change;
  }
  std::vector<const WorldBody*> added;
  std::vector<std::string> gone;
  for (const WorldBody& body : changed->world().bodies()) {
    const WorldBody* const old = checker.world().find(body.name);
    if (old == nullptr || !detail::isSameBody(checker, *old, *changed, body))
      added.push_back(&body);
  }
  for (const WorldBody& body : checker.world().bodies()) {
    const WorldBody* const now = changed->world().find(body.name);
    if (now == nullptr || std::ranges::find(added, now) != added.end()) gone.push_back(body.name);
  }
  return graph.change(std::move(changed), gone, added, threads, stop);
}

void detail::ProvenGraphData::findBoxes(std::size_t first, unsigned threads) {
  const std::size_t count = motions.size();
  table.resize(count);
  forEachIndex((count - first + kBatch - 1) / kBatch, threads, [&](std::size_t batch) {
    MotionBoxes::Scratch scratch;
    std::vector<SingleBox> boxes(boxesOf->boxes());
    const std::size_t begin = first + batch * kBatch;
    for (std::size_t i = begin; i < std::min(begin + kBatch, count); ++i) {
      boxesOf->find(state(motions[i].from), state(motions[i].to), boxes, scratch);
      table.put(i, boxes);
    }
  });
}

ProvenGraph::Change detail::ProvenGraphData::change(std::shared_ptr<const Checker> changed,
                                                    std::span<const std::string> gone,
                                                    std::span<const WorldBody* const> added,
                                                    unsigned threads, const std::stop_token& stop) {
  std::vector<BodyAnswer> answers;
  if (!added.empty()) {
    const LoneChecker lone(*changed);
    for (const WorldBody* body : added)
      answers.push_back(askBody(*this, *changed, lone, *body, 0, {}, {threads, stop}));
  }
  if (stop.stop_requested()) return {.stopped = true};

  // What can fail is done.
  ProvenGraph::Change change{.bodiesGone = gone.size(), .bodiesNew = added.size()};
  std::vector<char> isGone(names.size(), 0);
  for (std::size_t i = 0; i < names.size(); ++i)
    isGone[i] = std::ranges::find(gone, names[i]) != gone.end() ? 1 : 0;
  std::vector<char> wasFree(motions.size(), 0), wasAsked(motions.size(), 0);
  for (std::size_t i = 0; i < motions.size(); ++i) {
    wasFree[i] = blocks[i].empty() ? 1 : 0;
    std::erase_if(blocks[i], [&](const MotionBlock& block) { return isGone[block.body] != 0; });
  }
  for (std::size_t i = 0; i < answers.size(); ++i) {
    takeBlocks(answers[i], numberOf(added[i]->name), *this);
    change.byArithmetic += motions.size() - answers[i].asked.size();
    change.asked += answers[i].asked.size();
    for (const std::uint32_t motion : answers[i].asked) wasAsked[motion] = 1;
  }
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const bool isNow = blocks[i].empty();
    change.motionsAsked += wasAsked[i] != 0 ? 1 : 0;
    change.freed += isNow && wasFree[i] == 0 ? 1 : 0;
    change.blocked += !isNow && wasFree[i] != 0 ? 1 : 0;
  }
  checker = std::move(changed);
  return change;
}

}  // namespace swept
