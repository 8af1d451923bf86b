// SPDX-License-Identifier: BSD-3-Clause
// Schedules of two equal arms that face each other, planned by planSchedule() between random
// states: `schedule_benchmark URDF SRDF GROUP [RADIUS [SCHEDULES [DELAY [SAMPLES [SLOWEST]]]]]` (m
// from the middle, default 0.5; default 100 schedules; s, default 0; default 1000 delays of each;
// how many times as long each may take, default 1). Beside each the same two ways one after the
// other.
//
// A schedule that is proven is looked at each ms, by a cubic of its own between the points of the
// trajectories; with a delay or a slowdown also, each 10 ms, with random ones of one of the two. A
// state in collision refutes it, and ends with 2.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <iomanip>
#include <iostream>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "swept/ompl_bridge/schedule_plan.hpp"
#include "swept/robot_model/work_cell.hpp"

namespace {

using namespace swept;

constexpr double kAcceleration = 5.0;  // rad/s^2

std::shared_ptr<const Robot> facing(const char* urdf, const char* srdf, const std::string& group,
                                    double radius) {
  WorkCell cell{.name = "facing", .robots = {}, .groups = {{.name = "arms", .groups = {}}}};
  for (const int side : {0, 1}) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = Eigen::AngleAxisd(side * std::numbers::pi, Eigen::Vector3d::UnitZ()).matrix();
    pose.translation().x() = side == 0 ? -radius : radius;
    const std::string name = "arm" + std::to_string(side + 1);
    cell.robots.push_back({.name = name, .urdf = urdf, .srdf = srdf, .parent_from_robot = pose});
    cell.groups.front().groups.push_back(name + "/" + group);
  }
  return loadWorkCell(cell);
}

/// Where a trajectory is at a time (s): the cubic through positions and velocities.
void put(const JointTrajectory& trajectory, double time, double* q) {
  const std::vector<TrajectoryPoint>& points = trajectory.points;
  time = std::clamp(time, points.front().time, points.back().time);
  std::size_t i = 1;
  while (i + 1 < points.size() && points[i].time < time) ++i;
  const TrajectoryPoint &a = points[i - 1], &b = points[i];
  const double h = b.time - a.time, s = (time - a.time) / h;
  for (std::size_t v = 0; v < a.positions.size(); ++v) {
    const double way = b.positions[v] - a.positions[v];
    const double c2 = 3.0 * way - h * (2.0 * a.velocities[v] + b.velocities[v]);
    const double c3 = h * (a.velocities[v] + b.velocities[v]) - 2.0 * way;
    q[v] = a.positions[v] + s * (h * a.velocities[v] + s * (c2 + s * c3));
  }
}

/// By how much a trajectory is late (s), and how many times as long it takes.
struct Late {
  double delay = 0.0, slowdown = 1.0;
};

/// Samples in collision, with each trajectory as late as that.
int refuted(const Checker& checker, const PlannedSchedule& plan, double step,
            const std::vector<Late>& late, Workspace& workspace) {
  const std::size_t size = plan.trajectories.front().variables.size();
  std::vector<double> q(2 * size);
  double end = 0.0;
  for (std::size_t arm = 0; arm < 2; ++arm)
    end = std::max(
        end, late[arm].delay + late[arm].slowdown * plan.trajectories[arm].points.back().time);
  int count = 0;
  for (double time = 0.0; time <= end; time += step) {
    for (std::size_t arm = 0; arm < 2; ++arm)
      put(plan.trajectories[arm], (time - late[arm].delay) / late[arm].slowdown,
          q.data() + arm * size);
    if (checker.checkState(q, workspace) == Verdict::Collision) ++count;
  }
  return count;
}

double share(std::vector<double> values, double part) {
  if (values.empty()) return 0.0;
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
}

double lastArrival(const PlannedSchedule& plan) {
  double last = 0.0;
  for (const ScheduledCurve& curve : plan.curves) last = std::max(last, curve.curve.end());
  return last;
}

class Benchmark {
 public:
  Benchmark(std::shared_ptr<const Robot> robot, const std::string& group, double delay, int samples,
            double slowest)
      : robot_(std::move(robot)),
        checker_(robot_, "arms", std::make_shared<World>()),
        workspace_(checker_),
        delay_(delay),
        slowest_(slowest),
        samples_(samples) {
    for (const char* arm : {"arm1/", "arm2/"}) {
      const Group& own = *robot_->findGroup(arm + group);
      RateLimits limits = RateLimits::of(*robot_, own);
      limits.acceleration.assign(own.variables.size(), kAcceleration);
      tasks_.push_back({.group = own.name, .start = {}, .goals = {}, .limits = limits});
    }
  }

  int run(int count) {
    for (int i = 0; i < count; ++i) {
      takeStates();
      planBoth();
    }
    std::cout << "schedules " << count << ":";
    for (std::size_t status = 0; status < std::size(statuses_); ++status)
      if (statuses_[status] > 0)
        std::cout << ' ' << toString(static_cast<PlannedSchedule::Status>(status)) << ' '
                  << statuses_[status] << ';';
    std::cout << std::setprecision(3) << "\nplanning, s: median " << share(seconds_, 0.5)
              << ", 95 % " << share(seconds_, 0.95) << "\nlast arrival, s: median "
              << share(arrivals_, 0.5) << "; of one after the other, median of the ratios "
              << share(ratios_, 0.5) << " (" << ratios_.size() << " of both)\nsamples refuted "
              << refuted_ << "; delays " << delays_ << ", refuted " << delaysRefuted_ << '\n';
    return refuted_ + delaysRefuted_ > 0 ? 2 : 0;
  }

 private:
  std::vector<double> randomState() {
    std::vector<double> q;
    for (const int index : checker_.group().variables) {
      const Variable& variable = robot_->variables()[static_cast<std::size_t>(index)];
      q.push_back(std::uniform_real_distribution<double>(variable.lower, variable.upper)(random_));
    }
    return q;
  }

  /// Starts and goals at which both arms are free.
  void takeStates() {
    const std::size_t size = tasks_.front().limits.velocity.size();
    for (const bool isGoal : {false, true}) {
      std::vector<double> q = randomState();
      while (checker_.checkState(q, workspace_) != Verdict::Free) q = randomState();
      for (std::size_t arm = 0; arm < 2; ++arm) {
        const std::vector<double> own(q.begin() + static_cast<std::ptrdiff_t>(arm * size),
                                      q.begin() + static_cast<std::ptrdiff_t>((arm + 1) * size));
        if (isGoal)
          tasks_[arm].goals = {own};
        else
          tasks_[arm].start = own;
      }
    }
  }

  void planBoth() {
    const auto begin = std::chrono::steady_clock::now();
    const PlannedSchedule plan =
        planSchedule(checker_, tasks_, {}, {}, {.delay = delay_, .slowest = slowest_});
    seconds_.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    ++statuses_[static_cast<std::size_t>(plan.status)];
    if (!plan.found()) return;
    arrivals_.push_back(lastArrival(plan));
    refuted_ += refuted(checker_, plan, 1e-3, std::vector<Late>(2), workspace_);
    for (int k = 0; (delay_ > 0.0 || slowest_ > 1.0) && k < samples_; ++k) {
      std::vector<Late> late(2);
      late[static_cast<std::size_t>(k % 2)] = {
          std::uniform_real_distribution<double>(0.0, delay_)(random_),
          std::uniform_real_distribution<double>(1.0, slowest_)(random_)};
      ++delays_;
      delaysRefuted_ += refuted(checker_, plan, 1e-2, late, workspace_);
    }
    // The first waits at its start until the second has arrived, or the other way round.
    double best = std::numeric_limits<double>::infinity();
    for (const std::size_t first : {0U, 1U}) {
      const std::vector<ScheduleTask> own{tasks_[first]}, other{tasks_[1 - first]};
      const PlannedSchedule one = planSchedule(checker_, own, {}, standing(1 - first, false));
      const PlannedSchedule two = planSchedule(checker_, other, {}, standing(first, true));
      if (one.found() && two.found()) best = std::min(best, lastArrival(one) + lastArrival(two));
    }
    if (std::isfinite(best)) ratios_.push_back(lastArrival(plan) / best);
  }

  /// A configuration of both in which one arm is at its start or goal.
  std::vector<double> standing(std::size_t arm, bool atGoal) const {
    const std::vector<double>& own = atGoal ? tasks_[arm].goals.front() : tasks_[arm].start;
    std::vector<double> q(2 * own.size(), 0.0);
    std::ranges::copy(own, q.begin() + static_cast<std::ptrdiff_t>(arm * own.size()));
    return q;
  }

  const std::shared_ptr<const Robot> robot_;
  const Checker checker_;
  Workspace workspace_;
  const double delay_, slowest_;
  const int samples_;
  std::mt19937 random_{1};
  std::vector<ScheduleTask> tasks_;
  int statuses_[5] = {};
  std::vector<double> seconds_, arrivals_, ratios_;
  int refuted_ = 0, delays_ = 0, delaysRefuted_ = 0;
};

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 4) {
    std::cerr << "usage: schedule_benchmark URDF SRDF GROUP [RADIUS [SCHEDULES [DELAY [SAMPLES "
                 "[SLOWEST]]]]]\n";
    return 1;
  }
  const double radius = argc > 4 ? std::stod(argv[4]) : 0.5;
  const int count = argc > 5 ? std::stoi(argv[5]) : 100;
  const double delay = argc > 6 ? std::stod(argv[6]) : 0.0;
  const int samples = argc > 7 ? std::stoi(argv[7]) : 1000;
  const double slowest = argc > 8 ? std::stod(argv[8]) : 1.0;
  return Benchmark(facing(argv[1], argv[2], argv[3], radius), argv[3], delay, samples, slowest)
      .run(count);
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
