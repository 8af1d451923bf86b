// SPDX-License-Identifier: BSD-3-Clause
#include "run.hpp"

#include <sys/resource.h>

#include <chrono>
#include <latch>
#include <stdexcept>
#include <thread>

#include "models.hpp"
#include "worker.hpp"

namespace soak {

namespace {

constexpr std::size_t kWaiting = 32;  // samples, and so versions that live on for them

double seconds() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

double processorSeconds() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  const auto sum = [](const timeval& a, const timeval& b) {
    return static_cast<double>(a.tv_sec + b.tv_sec) +
           1e-6 * static_cast<double>(a.tv_usec + b.tv_usec);
  };
  return sum(usage.ru_utime, usage.ru_stime);
}

void updateWorlds(Shared& shared, const std::atomic<bool>& done) {
  std::size_t next = 0;
  while (!done) {
    if (shared.progress.updateDue()) {
      shared.lines[next++ % shared.lines.size()]->update();
      shared.progress.updated();
    } else {
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
  }
}

std::vector<std::unique_ptr<Worker>> makeWorkers(Shared& shared, const Options& options) {
  std::vector<std::unique_ptr<Worker>> workers;
  for (int i = 0; i < options.threads; ++i) {
    const auto part = [&](std::int64_t all) {
      return all * (i + 1) / options.threads - all * i / options.threads;
    };
    workers.push_back(
        std::make_unique<Worker>(shared, i, part(options.states), part(options.motions)));
  }
  return workers;
}

/// Until all workers are done: reads the memory when it is time, and listens for the interrupt.
void watch(Shared& shared, std::latch& working, Result& result,
           const std::function<bool()>& interrupted) {
  for (bool last = false; !last;) {
    last = working.try_wait();
    if (!result.interrupted && interrupted()) {
      result.interrupted = true;
      shared.progress.stop();
    }
    // A short soak may pass several moments at once.
    while (result.resident.due(shared.progress.share())) {
      result.resident.add(residentMebibytes());
      result.heap.add(heapMebibytes());
    }
    if (!last) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

void soakAll(Shared& shared, std::vector<std::unique_ptr<Worker>>& workers, Refutation& refutation,
             Result& result, const std::function<bool()>& interrupted) {
  std::latch working(static_cast<std::ptrdiff_t>(workers.size()));
  std::atomic<bool> done{false};
  std::jthread updater([&] { updateWorlds(shared, done); });
  std::jthread judge([&] {
    while (const auto sample = shared.samples.pop()) refutation.judge(*sample);
  });
  {
    std::vector<std::jthread> threads;
    for (const auto& worker : workers) {
      threads.emplace_back([&] {
        worker->run();
        working.count_down();
      });
    }
    watch(shared, working, result, interrupted);
  }
  done = true;
  shared.samples.close();
}

}  // namespace

std::vector<std::unique_ptr<Stage>> makeStages(const Options& options) {
  std::vector<std::unique_ptr<Stage>> stages;
  if (!options.files.robot.empty()) {
    stages.push_back(std::make_unique<Stage>(options.files, options.seed, options.margin));
    return stages;
  }
  for (const Model& model : kModels) {
    const double margin = model.name == "rook6" ? 0.005 : 0.0;  // m
    stages.push_back(std::make_unique<Stage>(filesOf(model), options.seed, margin));
  }
  return stages;
}

Result run(const Options& options, const std::vector<std::unique_ptr<Stage>>& stages,
           std::ostream& out, const std::function<bool()>& interrupted) {
  Failures failures(out);
  Shared shared{.lines = {},
                .samples = SampleQueue(kWaiting),
                .failures = failures,
                .progress = Progress(options.states + options.motions, options.updates),
                .seed = options.seed,
                .sampleOneIn = options.sampleOneIn};
  for (const auto& stage : stages)
    shared.lines.push_back(
        std::make_unique<WorldLine>(*stage, options.seed * 31 + shared.lines.size()));
  std::vector<std::unique_ptr<Worker>> workers = makeWorkers(shared, options);
  Refutation refutation(options.seed, failures);

  Result result;
  const double start = seconds(), startProcessor = processorSeconds();
  soakAll(shared, workers, refutation, result, interrupted);
  result.seconds = seconds() - start;
  result.processorSeconds = processorSeconds() - startProcessor;

  result.judged = refutation.counts();
  result.failures = failures.count();
  result.tallies.resize(stages.size());
  for (std::size_t i = 0; i < stages.size(); ++i) {
    result.stages.push_back(stages[i]->name());
    result.updates.add(shared.lines[i]->counts());
    for (const auto& worker : workers) result.tallies[i].add(worker->tallies()[i]);
  }
  return result;
}

namespace {

WorldKey keyOf(const Question& question, const Stage& stage) {
  try {
    return parseWorldKey(question.world, stage.places(), Stage::kForms);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(std::string("--world: ") + error.what());
  }
}

void requireSize(const char* option, const std::vector<double>& q, const Stage& stage) {
  const int wanted = stage.empty().dimension();
  if (static_cast<int>(q.size()) == wanted) return;
  throw std::invalid_argument(std::string(option) + " has " + std::to_string(q.size()) +
                              " values, and the group " + std::to_string(wanted));
}

}  // namespace

int askAgain(const Stage& stage, const Options& options, std::ostream& out) {
  const Question& question = *options.question;
  const WorldKey key = keyOf(question, stage);
  requireSize("--from", question.from, stage);
  if (!question.to.empty()) requireSize("--to", question.to, stage);
  const auto world = std::make_shared<const swept::World>(stage.worldOf(key));
  Sample sample;
  sample.version = std::make_shared<const Version>(stage, key, stage.empty().withWorld(world));
  sample.from = question.from;
  sample.to = question.to;
  sample.query =
      question.verdictOnly ? swept::MotionQuery::VerdictOnly : swept::MotionQuery::FirstContact;
  sample.answer = ask(*sample.version->checker, sample);
  out << reproducer(sample, options.seed) << '\n';
  Failures failures(out);
  Refutation(options.seed, failures).judge(sample);
  out << failures.count() << " failures" << std::endl;
  return failures.count() == 0 ? 0 : 1;
}

}  // namespace soak
