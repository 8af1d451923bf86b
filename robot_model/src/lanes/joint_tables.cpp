// SPDX-License-Identifier: BSD-3-Clause
#include "lanes/joint_tables.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "kinematics/for_each_index.hpp"
#include "lanes/lane_model.hpp"
#include "lanes/table_builder.hpp"
#include "lanes/table_candidates.hpp"

namespace swept::detail {

namespace {

/// See PairProof::work: for the cells of all tables of a robot, and for their parts; some
/// 30 ns each.
constexpr int kMostWork = 12'000'000;
constexpr int kMostPartWork = 600'000;
/// What some tables leave of their share goes to the others, so often.
constexpr int kRounds = 4;
constexpr int kLeastShare = 10'000;

struct Task {
  std::int32_t bodies = 0;  ///< index into LaneModel::bodyPairs
  std::unique_ptr<TableBuilder> builder;
  int work = 0;
};

/// Work in equal shares for those that are not done.
template <typename Done, typename Work>
void share(std::vector<Task>& tasks, int most, const Done& done, const Work& work) {
  int left = most;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Task*> open;
    for (Task& task : tasks)
      if (!done(*task.builder)) open.push_back(&task);
    const int each = open.empty() ? 0 : left / static_cast<int>(open.size());
    if (each < kLeastShare) return;
    for (Task* task : open) task->work = each;
    forEachIndex(open.size(), 0, [&](std::size_t i) { work(*open[i]->builder, open[i]->work); });
    for (const Task* task : open) left -= each - task->work;
  }
}

/// Per pair of bodies, whether none of the pairs of its geometry ever meets.
std::vector<char> neverPairs(const CheckerModel& model, const LaneModel& lanes) {
  std::set<std::pair<int, int>> never;
  for (const BodyPair& pair : model.bodyPairs)
    if (pair.never) never.emplace(pair.a, pair.b);
  std::vector<char> all(lanes.bodyPairs.size(), 1);
  for (const LanePairSource& source : lanes.sources) {
    if (source.obstacle >= 0) continue;
    const std::pair carriers{model.robotGeometry[source.geometry].carrier,
                             model.robotGeometry[source.other].carrier};
    if (!never.contains(carriers)) all[source.bodyPair] = 0;
  }
  return all;
}

/// The pairs of geometry of those pairs of bodies, in their order.
std::vector<JointTable::Pairs> geometriesOf(const CheckerModel& model, const LaneModel& lanes,
                                            const std::vector<std::int32_t>& bodyPairs) {
  std::vector<std::int32_t> indexOf(lanes.bodyPairs.size(), -1);
  for (std::size_t i = 0; i < bodyPairs.size(); ++i)
    indexOf[bodyPairs[i]] = static_cast<std::int32_t>(i);
  std::vector<JointTable::Pairs> pairs(bodyPairs.size());
  for (std::size_t i = 0; i < lanes.sources.size(); ++i) {
    const LanePairSource& source = lanes.sources[i];
    if (source.obstacle >= 0 || indexOf[source.bodyPair] < 0) continue;
    pairs[indexOf[source.bodyPair]].push_back(
        {source.geometry, source.other, model.pairs[i].kept()});
  }
  return pairs;
}

bool sameGeometry(const RobotGeometry& a, const RobotGeometry& b) {
  return a.cover == b.cover && a.cover != nullptr;
}

bool holdsFor(const CheckerModel& model, const JointTables& tables, const JointTable& table,
              const GeometryPair& pair) {
  const auto known = std::ranges::find_if(table.pairs, [&](const JointTable::Geometries& other) {
    return other.a == pair.a && other.b == pair.b;
  });
  return known != table.pairs.end() && known->margin >= pair.kept() &&
         sameGeometry(tables.geometry[pair.a], model.robotGeometry[pair.a]) &&
         sameGeometry(tables.geometry[pair.b], model.robotGeometry[pair.b]);
}

/// Of pairs of bodies that never meet.
void addAllApart(const CheckerModel& model, const LaneModel& lanes, const std::vector<char>& never,
                 JointTables& tables) {
  std::vector<std::int32_t> bodyPairs;
  for (std::size_t i = 0; i < never.size(); ++i)
    if (never[i] != 0) bodyPairs.push_back(static_cast<std::int32_t>(i));
  std::vector<JointTable::Pairs> pairs = geometriesOf(model, lanes, bodyPairs);
  for (std::size_t i = 0; i < bodyPairs.size(); ++i) {
    const LaneBodyPair& bodies = lanes.bodyPairs[bodyPairs[i]];
    tables.entries.push_back(
        {bodies.bodyA, bodies.bodyB,
         std::make_shared<const JointTable>(JointTable::allApart(std::move(pairs[i])))});
  }
}

std::vector<Task> tasksOf(const CheckerModel& model, const LaneModel& lanes,
                          const std::vector<char>& never) {
  const TableCandidates candidates = tableCandidates(model, lanes, never, kMostWork / kLeastShare);
  std::vector<JointTable::Pairs> pairs = geometriesOf(model, lanes, candidates.bodyPairs);
  std::vector<Task> tasks;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const LaneBodyPair& bodies = lanes.bodyPairs[candidates.bodyPairs[i]];
    const std::optional<TableMotion> motion =
        TableMotion::between(model, lanes, bodies, candidates.coarseness);
    if (!motion) continue;
    tasks.push_back(
        {candidates.bodyPairs[i],
         std::make_unique<TableBuilder>(model, lanes, bodies, *motion, std::move(pairs[i])), 0});
  }
  return tasks;
}

}  // namespace

std::shared_ptr<const JointTables> buildJointTables(const CheckerModel& model,
                                                    const LaneModel& lanes) {
  auto tables = std::make_shared<JointTables>();
  tables->geometry = model.robotGeometry;
  const std::vector<char> never = neverPairs(model, lanes);
  addAllApart(model, lanes, never, *tables);
  std::vector<Task> tasks = tasksOf(model, lanes, never);
  share(
      tasks, kMostWork, [](const TableBuilder& builder) { return builder.proven(); },
      [](TableBuilder& builder, int& work) { builder.prove(work); });
  share(
      tasks, kMostPartWork, [](const TableBuilder& builder) { return builder.refined(); },
      [](TableBuilder& builder, int& work) { builder.refine(work); });
  for (Task& task : tasks) {
    const LaneBodyPair& bodies = lanes.bodyPairs[task.bodies];
    if (auto table = task.builder->finish())
      tables->entries.push_back({bodies.bodyA, bodies.bodyB, std::move(table)});
  }
  return tables;
}

void chooseTables(const CheckerModel& model, const JointTables& tables, LaneModel& lanes) {
  std::map<std::pair<int, int>, std::shared_ptr<const JointTable>> tableOf;
  for (const JointTables::Entry& entry : tables.entries)
    tableOf.insert_or_assign({entry.bodyA, entry.bodyB}, entry.table);
  for (LaneBodyPair& bodies : lanes.bodyPairs) {
    const auto known = tableOf.find({bodies.bodyA, bodies.bodyB});
    if (known != tableOf.end()) bodies.table = known->second;
  }
  for (std::size_t i = 0; i < lanes.sources.size(); ++i) {
    const LanePairSource& source = lanes.sources[i];
    if (source.obstacle >= 0) continue;
    std::shared_ptr<const JointTable>& table = lanes.bodyPairs[source.bodyPair].table;
    if (table != nullptr && !holdsFor(model, tables, *table, model.pairs[i])) table = nullptr;
  }
}

}  // namespace swept::detail
