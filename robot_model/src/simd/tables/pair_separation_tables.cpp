// SPDX-License-Identifier: BSD-3-Clause
#include "simd/tables/pair_separation_tables.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "robot/shape_cover.hpp"
#include "simd/compile/simd_model.hpp"
#include "simd/tables/table_builder.hpp"
#include "simd/tables/table_candidates.hpp"
#include "threads/for_each_index.hpp"

namespace swept::detail {

namespace {

/// See PairProof::work: for the cells of all tables of a robot, and for their parts; some 30 ns
/// each.
constexpr int kMostWork = 12'000'000;
constexpr int kMostPartWork = 600'000;
/// Number of rounds in which the unused shares of some tables go to the others.
constexpr int kRounds = 4;
constexpr int kLeastShare = 10'000;

struct Task {
  std::int32_t bodies = 0;  ///< index into SimdModel::bodyPairs
  std::unique_ptr<TableBuilder> builder;
  int work = 0;
};

/// Distributes work in equal shares among those that are not done.
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
std::vector<char> neverPairs(const PairModel& model, const SimdModel& simd) {
  std::set<std::pair<int, int>> never;
  for (const BodyPair& pair : model.bodyPairs)
    if (pair.never) never.emplace(pair.a, pair.b);
  std::vector<char> all(simd.bodyPairs.size(), 1);
  for (const SimdPairSource& source : simd.sources) {
    if (source.obstacle >= 0) continue;
    const std::pair collisionBodies{model.robotGeometry[source.geometry].collisionBody,
                                    model.robotGeometry[source.other].collisionBody};
    if (!never.contains(collisionBodies)) all[source.bodyPair] = 0;
  }
  return all;
}

/// The pairs of geometry of those pairs of bodies, in their order.
std::vector<PairSeparationTable::Pairs> geometriesOf(const PairModel& model, const SimdModel& simd,
                                                     const std::vector<std::int32_t>& bodyPairs) {
  std::vector<std::int32_t> indexOf(simd.bodyPairs.size(), -1);
  for (std::size_t i = 0; i < bodyPairs.size(); ++i)
    indexOf[bodyPairs[i]] = static_cast<std::int32_t>(i);
  std::vector<PairSeparationTable::Pairs> pairs(bodyPairs.size());
  for (std::size_t i = 0; i < simd.sources.size(); ++i) {
    const SimdPairSource& source = simd.sources[i];
    if (source.obstacle >= 0 || indexOf[source.bodyPair] < 0) continue;
    pairs[indexOf[source.bodyPair]].push_back(
        {source.geometry, source.other, model.pair(i).kept()});
  }
  return pairs;
}

/// Whether it is the same piece in the same place. Pieces of equal shape may share a cover,
/// wherever they are.
bool sameGeometry(const RobotGeometry& a, const RobotGeometry& b) {
  return a.cover == b.cover && a.cover != nullptr && a.scale == b.scale && a.body == b.body &&
         a.body_from_shape.matrix() == b.body_from_shape.matrix() && areSame(a.shape, b.shape);
}

bool holdsFor(const PairModel& model, const PairSeparationTables& tables,
              const PairSeparationTable& table, const GeometryPair& pair) {
  const auto known =
      std::ranges::find_if(table.pairs, [&](const PairSeparationTable::Geometries& other) {
        return other.a == pair.a && other.b == pair.b;
      });
  return known != table.pairs.end() && known->margin >= pair.kept() &&
         sameGeometry(tables.geometry[pair.a], model.robotGeometry[pair.a]) &&
         sameGeometry(tables.geometry[pair.b], model.robotGeometry[pair.b]);
}

/// For pairs of bodies that never meet.
void addAllApart(const PairModel& model, const SimdModel& simd, const std::vector<char>& never,
                 PairSeparationTables& tables) {
  std::vector<std::int32_t> bodyPairs;
  for (std::size_t i = 0; i < never.size(); ++i)
    if (never[i] != 0) bodyPairs.push_back(static_cast<std::int32_t>(i));
  std::vector<PairSeparationTable::Pairs> pairs = geometriesOf(model, simd, bodyPairs);
  for (std::size_t i = 0; i < bodyPairs.size(); ++i) {
    const SimdBodyPair& bodies = simd.bodyPairs[bodyPairs[i]];
    tables.entries.push_back({bodies.bodyA, bodies.bodyB,
                              std::make_shared<const PairSeparationTable>(
                                  PairSeparationTable::allApart(std::move(pairs[i])))});
  }
}

std::vector<Task> tasksOf(const PairModel& model, const SimdModel& simd,
                          const std::vector<char>& never) {
  const TableCandidates candidates = tableCandidates(model, simd, never, kMostWork / kLeastShare);
  std::vector<PairSeparationTable::Pairs> pairs = geometriesOf(model, simd, candidates.bodyPairs);
  std::vector<Task> tasks;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const SimdBodyPair& bodies = simd.bodyPairs[candidates.bodyPairs[i]];
    const std::optional<TableMotion> motion =
        TableMotion::between(model, simd, bodies, candidates.coarseness);
    if (!motion) continue;
    tasks.push_back(
        {candidates.bodyPairs[i],
         std::make_unique<TableBuilder>(model, simd, bodies, *motion, std::move(pairs[i])), 0});
  }
  return tasks;
}

}  // namespace

std::shared_ptr<const PairSeparationTables> buildPairSeparationTables(const PairModel& model,
                                                                      const SimdModel& simd) {
  auto tables = std::make_shared<PairSeparationTables>();
  tables->geometry = model.robotGeometry;
  const std::vector<char> never = neverPairs(model, simd);
  addAllApart(model, simd, never, *tables);
  std::vector<Task> tasks = tasksOf(model, simd, never);
  share(
      tasks, kMostWork, [](const TableBuilder& builder) { return builder.proven(); },
      [](TableBuilder& builder, int& work) { builder.prove(work); });
  share(
      tasks, kMostPartWork, [](const TableBuilder& builder) { return builder.refined(); },
      [](TableBuilder& builder, int& work) { builder.refine(work); });
  for (Task& task : tasks) {
    const SimdBodyPair& bodies = simd.bodyPairs[task.bodies];
    if (auto table = task.builder->finish())
      tables->entries.push_back({bodies.bodyA, bodies.bodyB, std::move(table)});
  }
  return tables;
}

void chooseTables(const PairModel& model, const PairSeparationTables& tables, SimdModel& simd) {
  std::map<std::pair<int, int>, std::shared_ptr<const PairSeparationTable>> tableOf;
  for (const PairSeparationTables::Entry& entry : tables.entries)
    tableOf.insert_or_assign({entry.bodyA, entry.bodyB}, entry.table);
  for (SimdBodyPair& bodies : simd.bodyPairs) {
    const auto known = tableOf.find({bodies.bodyA, bodies.bodyB});
    if (known != tableOf.end()) bodies.table = known->second;
  }
  for (std::size_t i = 0; i < simd.sources.size(); ++i) {
    const SimdPairSource& source = simd.sources[i];
    if (source.obstacle >= 0) continue;
    std::shared_ptr<const PairSeparationTable>& table = simd.bodyPairs[source.bodyPair].table;
    if (table != nullptr && !holdsFor(model, tables, *table, model.pair(i))) table = nullptr;
  }
}

void addTables(const PairModel& model, const SimdModel* like, SimdModel& simd) {
  if (!simd.usable) return;
  simd.tables = like == nullptr ? buildPairSeparationTables(model, simd) : like->tables;
  if (simd.tables != nullptr) chooseTables(model, *simd.tables, simd);
}

}  // namespace swept::detail
