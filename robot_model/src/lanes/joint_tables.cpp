// SPDX-License-Identifier: BSD-3-Clause
#include "lanes/joint_tables.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>

#include "lanes/lane_model.hpp"
#include "lanes/table_builder.hpp"

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
  std::size_t bodies = 0;  ///< index into LaneModel::bodyPairs
  std::unique_ptr<TableBuilder> builder;
  int work = 0;
  std::exception_ptr failure;
};

template <typename Work>
void forEach(std::vector<Task*>& tasks, const Work& work) {
  std::atomic<std::size_t> next{0};
  const auto some = [&] {
    for (std::size_t i = next++; i < tasks.size(); i = next++) {
      try {
        work(*tasks[i]);
      } catch (...) {
        tasks[i]->failure = std::current_exception();
      }
    }
  };
  const std::size_t threads =
      std::min<std::size_t>(std::max(1U, std::thread::hardware_concurrency()), tasks.size());
  {
    std::vector<std::jthread> others;
    for (std::size_t i = 1; i < threads; ++i) others.emplace_back(some);
    some();
  }
  for (const Task* task : tasks)
    if (task->failure) std::rethrow_exception(task->failure);
}

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
    forEach(open, [&](Task& task) { work(*task.builder, task.work); });
    for (const Task* task : open) left -= each - task->work;
  }
}

}  // namespace

std::vector<std::shared_ptr<const JointTable>> buildJointTables(const CheckerModel& model,
                                                                const LaneModel& lanes) {
  std::vector<Task> tasks;
  for (std::size_t i = 0; i < lanes.bodyPairs.size(); ++i) {
    const LaneBodyPair& bodies = lanes.bodyPairs[i];
    const std::optional<TableMotion> motion = TableMotion::between(model, lanes, bodies);
    if (!motion) continue;
    Task& task = tasks.emplace_back();
    task.bodies = i;
    task.builder = std::make_unique<TableBuilder>(model, lanes, bodies, *motion);
  }
  share(
      tasks, kMostWork, [](const TableBuilder& builder) { return builder.proven(); },
      [](TableBuilder& builder, int& work) { builder.prove(work); });
  share(
      tasks, kMostPartWork, [](const TableBuilder& builder) { return builder.refined(); },
      [](TableBuilder& builder, int& work) { builder.refine(work); });
  std::vector<std::shared_ptr<const JointTable>> tables(lanes.bodyPairs.size());
  for (Task& task : tasks) tables[task.bodies] = task.builder->finish();
  return tables;
}

}  // namespace swept::detail
