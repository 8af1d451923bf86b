// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "broadphase_worlds.hpp"

namespace swept::benchmark {

/// Arms of eight links, each in a cell of 2 m with a shelf. In a step one joint of each arm turns
/// by a quarter or more. All coordinates are multiples of 1/16 m, so many endpoints are the same;
/// boards, and some links, have no thickness. Unlike `MovingBoxes` these grow and shrink.
class FoldingRobots : public BoxWorld {
 public:
  FoldingRobots(std::size_t count, std::uint64_t seed) : random_(seed) {
    const auto cells = static_cast<std::size_t>(
        std::lround(std::cbrt(static_cast<double>(count) / (kLinks + kThings))));
    side_ = kCell * static_cast<double>(cells);
    for (std::size_t i = 0; i < cells * cells * cells; ++i) {
      const auto x = i % cells, y = i / cells % cells, z = i / cells / cells;
      const Eigen::Vector3d lower =
          kCell *
          Eigen::Vector3d(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
      for (std::size_t link = 0; link < kLinks; ++link)
        moving_.push_back(static_cast<std::uint32_t>(boxes_.size() + link));
      boxes_.insert(boxes_.end(), kLinks, {lower, lower});
      boxes_.push_back({lower, lower + Eigen::Vector3d(kCell, kCell, 0.0)});
      for (int thing = 1; thing < static_cast<int>(kThings); ++thing) {
        const Eigen::Vector3d corner = lower + Eigen::Vector3d(0.25 * thing, 0.75, 0.0);
        boxes_.push_back({corner, corner + Eigen::Vector3d(0.25, 0.5, 0.25)});
      }
      arms_.push_back({lower + Eigen::Vector3d::Constant(0.5 * kCell), {}});
      place(i);
    }
  }

  void step() override {
    std::uniform_int_distribution<std::size_t> joint(0, kLinks - 1);
    std::uniform_int_distribution<int> turns(0, 3);
    for (std::size_t arm = 0; arm < arms_.size(); ++arm) {
      arms_[arm].turns[joint(random_)] = turns(random_);
      place(arm);
    }
  }

 private:
  static constexpr std::size_t kLinks = 8, kThings = 8;
  static constexpr double kCell = 2.0;  ///< m

  struct Arm {
    Eigen::Vector3d base;  ///< m
    std::array<int, kLinks> turns;
  };

  /// Joints turn around z and y in turn.
  void place(std::size_t arm) {
    Eigen::Vector3d at = arms_[arm].base;
    Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();
    for (std::size_t link = 0; link < kLinks; ++link) {
      Eigen::Matrix3d quarter;
      if (link % 2 == 0)
        quarter << 0, -1, 0, 1, 0, 0, 0, 0, 1;
      else
        quarter << 0, 0, 1, 0, 1, 0, -1, 0, 0;
      for (int i = 0; i < arms_[arm].turns[link]; ++i) turned = turned * quarter;
      const Eigen::Vector3d half(0.125, link % 3 == 0 ? 0.0 : 0.0625, 0.0625);
      const Eigen::Vector3d extent = turned.cwiseAbs() * half;
      const Eigen::Vector3d middle = at + 0.125 * turned.col(0);
      boxes_[arm * (kLinks + kThings) + link] = {middle - extent, middle + extent};
      at += 0.25 * turned.col(0);
    }
  }

  std::mt19937_64 random_;
  std::vector<Arm> arms_;
};

/// Runs the work in a process of its own. Empty if it came to its end, else what happened.
inline std::string mishapOf(const std::function<void()>& work, unsigned patience) {
  const pid_t child = fork();
  if (child == 0) {
    alarm(patience);
    work();
    _exit(0);
  }
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) != child) return "not tried";
  if (WIFEXITED(status)) return WEXITSTATUS(status) == 0 ? "" : "crash";
  return WTERMSIG(status) == SIGALRM ? "no end in " + std::to_string(patience) + " s" : "crash";
}

}  // namespace swept::benchmark
