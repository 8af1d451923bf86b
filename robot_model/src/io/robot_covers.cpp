// SPDX-License-Identifier: BSD-3-Clause
#include "io/robot_covers.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <thread>

#include "kinematics/shape_cover.hpp"

namespace swept::detail {
namespace {

/// A cover to build, and the geometries that get it.
struct Task {
  std::vector<CollisionGeometry*> of;
  std::shared_ptr<const SphereCover> cover;
  double seconds = 0.0;
  std::exception_ptr failure;
};

std::vector<Task> tasksOf(std::vector<Link>& links) {
  std::vector<Task> tasks;
  for (Link& link : links) {
    for (CollisionGeometry& geometry : link.collision) {
      if (!isBounded(geometry.shape)) continue;
      const auto known = std::find_if(tasks.begin(), tasks.end(), [&](const Task& task) {
        return areSame(task.of.front()->shape, geometry.shape);
      });
      if (known != tasks.end()) {
        known->of.push_back(&geometry);
      } else {
        tasks.emplace_back().of.push_back(&geometry);
      }
    }
  }
  return tasks;
}

void build(Task& task) {
  const auto start = std::chrono::steady_clock::now();
  try {
    task.cover = coverOf(task.of.front()->shape);
  } catch (...) {
    task.failure = std::current_exception();
  }
  task.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::size_t sizeOf(const Task& task) {
  const auto* mesh = std::get_if<TriangleMesh>(&task.of.front()->shape);
  return mesh == nullptr ? 0 : mesh->triangles().size();
}

}  // namespace

void addCovers(std::vector<Link>& links, unsigned threads) {
  std::vector<Task> tasks = tasksOf(links);
  // The large ones first, lest the last thread be left with one.
  std::vector<Task*> order;
  for (Task& task : tasks) order.push_back(&task);
  std::stable_sort(order.begin(), order.end(),
                   [](const Task* a, const Task* b) { return sizeOf(*a) > sizeOf(*b); });
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < order.size(); i = next++) build(*order[i]);
  };
  {
    std::vector<std::jthread> others;
    for (std::size_t i = 1; i < std::min<std::size_t>(threads, order.size()); ++i) {
      others.emplace_back(work);
    }
    work();
  }
  for (Task& task : tasks) {
    if (task.failure) std::rethrow_exception(task.failure);
    for (CollisionGeometry* geometry : task.of) {
      geometry->cover = task.cover;
      geometry->coverSeconds = geometry == task.of.front() ? task.seconds : 0.0;
    }
  }
}

}  // namespace swept::detail
