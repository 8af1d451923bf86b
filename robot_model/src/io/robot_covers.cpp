// SPDX-License-Identifier: BSD-3-Clause
#include "io/robot_covers.hpp"

#include <algorithm>
#include <chrono>

#include "robot/shape_cover.hpp"
#include "threads/for_each_index.hpp"

namespace swept::detail {
namespace {

/// A cover to build, and the geometries that get it.
struct Task {
  std::vector<CollisionGeometry*> of;
  std::shared_ptr<const SphereCover> cover;
  double seconds = 0.0;
};

std::vector<Task> tasksOf(std::vector<Link>& links) {
  std::vector<Task> tasks;
  for (Link& link : links) {
    for (CollisionGeometry& geometry : link.collision) {
      if (geometry.cover || !isBounded(geometry.shape)) continue;
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
  task.cover = coverOf(task.of.front()->shape);
  task.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::size_t sizeOf(const Task& task) {
  const auto* mesh = std::get_if<TriangleMesh>(&task.of.front()->shape);
  return mesh == nullptr ? 0 : mesh->triangles().size();
}

}  // namespace

void addCovers(std::vector<Link>& links, unsigned threads) {
  std::vector<Task> tasks = tasksOf(links);
  // The large ones first, so that the last thread is not left with one of them.
  std::vector<Task*> order;
  for (Task& task : tasks) order.push_back(&task);
  std::stable_sort(order.begin(), order.end(),
                   [](const Task* a, const Task* b) { return sizeOf(*a) > sizeOf(*b); });
  forEachIndex(order.size(), threads, [&](std::size_t i) { build(*order[i]); });
  for (Task& task : tasks) {
    for (CollisionGeometry* geometry : task.of) {
      geometry->cover = task.cover;
      geometry->coverSeconds = geometry == task.of.front() ? task.seconds : 0.0;
    }
  }
}

}  // namespace swept::detail
