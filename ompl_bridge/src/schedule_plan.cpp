// SPDX-License-Identifier: BSD-3-Clause
#include "swept/ompl_bridge/schedule_plan.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <set>
#include <stdexcept>
#include <utility>

#include "number_text.hpp"
#include "priority_orders.hpp"
#include "schedule_task.hpp"
#include "space_time_improvement.hpp"
#include "space_time_search.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/core/verdict.hpp"
#include "swept/robot_model/schedule_checker.hpp"
#include "timed_polyline.hpp"

namespace swept {

namespace {

using detail::OwnTask;
using detail::requirePlan;
using Status = PlannedSchedule::Status;
using Clock = std::chrono::steady_clock;

constexpr double kRestResolution = 1e-3;  // s
/// Of the longest way that was found. Half of it is about when two meet that exchange their places.
constexpr double kFirstWait = 0.5;

/// A robot that stays where it is.
PiecewisePolynomial resting(const Eigen::VectorXd& q) {
  return {{0.0, kRestResolution}, {q.replicate(1, 2)}};
}

/// What one attempt for one robot gave.
struct Way {
  Status status = Status::NotFound;
  std::optional<Witness> contact = {};
  std::optional<JointTrajectory> trajectory = {};
};

/// Finds the way of one robot beside curves that are known.
class WaySearch {
 public:
  /// `wait`: s, on the clock. It stays at its start until then, if it may.
  WaySearch(const ScheduleChecker& checker, const OwnTask& own, const SchedulePlanOptions& options,
            double wait, std::function<bool()> stop)
      : checker_(checker),
        own_(own),
        options_(options),
        wait_(wait),
        stop_(std::move(stop)),
        workspace_(checker.checker()) {}

  Way run() {
    const TrajectoryCertificate start = rest(own_.start, 0.0, kRestResolution);
    if (start.verdict != Verdict::Free) return {Status::StartNotFree, witnessOf(start)};
    std::vector<detail::TimedGoal> goals;
    std::optional<Witness> contact;
    for (const Eigen::VectorXd& goal : own_.goals) {
      if (const std::optional<double> from = restFrom(goal, contact)) {
        if (*from <= options_.latest) goals.push_back({goal, *from});
      }
    }
    if (goals.empty())
      return {contact ? Status::GoalNotFree : Status::NotFound, std::move(contact)};
    return search(goals);
  }

 private:
  static std::optional<Witness> witnessOf(const TrajectoryCertificate& certificate) {
    if (!certificate.contact) return std::nullopt;
    return certificate.contact->witness;
  }

  TrajectoryCertificate rest(const Eigen::VectorXd& q, double from, double to) {
    return checker_.certify({{from, to}, {q.replicate(1, 2)}}, workspace_);
  }

  /// s, since when the robot may stay there. No value, and a contact: not even at the end.
  std::optional<double> restFrom(const Eigen::VectorXd& goal, std::optional<Witness>& contact) {
    const double end = std::max(checker_.end(), kRestResolution);
    const auto staysFree = [&](double from) {
      return rest(goal, from, end + kRestResolution).verdict == Verdict::Free;
    };
    const TrajectoryCertificate last = rest(goal, end, end + kRestResolution);
    if (last.verdict != Verdict::Free) {
      contact = witnessOf(last);
      return std::nullopt;
    }
    if (staysFree(0.0)) return 0.0;
    double blocked = 0.0, free = end;
    while (free - blocked > kRestResolution) {
      const double middle = 0.5 * (blocked + free);
      (staysFree(middle) ? free : blocked) = middle;
    }
    return free;
  }

  Way search(const std::vector<detail::TimedGoal>& goals) {
    const bool waits = wait_ > 0.0 && wait_ < options_.latest &&
                       rest(own_.start, 0.0, wait_).verdict == Verdict::Free;
    const double begin = waits ? wait_ : 0.0;
    detail::SpaceTimeSearch trees(checker_, own_.space, options_.seed);
    std::vector<detail::TimedKnot> knots =
        trees.run({own_.start, begin}, goals, options_.latest, stop_);
    if (knots.empty()) return {};
    knots = detail::improved(checker_, own_.space, std::move(knots),
                             {.begin = begin,
                              .restFrom = goals[trees.goal()].restFrom,
                              .attempts = options_.improvements},
                             options_.seed, stop_);
    // A robot that is at its goal stays there.
    const std::optional<PiecewisePolynomial> curve =
        knots.size() == 1 ? resting(knots.front().q)
                          : detail::blended(knots, 0.0, own_.space.bounds);
    if (!curve) return {};
    std::optional<JointTrajectory> trajectory = controllerTrajectory(*curve, own_.names);
    if (!trajectory) return {};
    return {.status = Status::Found, .trajectory = std::move(trajectory)};
  }

  const ScheduleChecker& checker_;
  const OwnTask& own_;
  const SchedulePlanOptions& options_;
  const double wait_;  ///< s
  const std::function<bool()> stop_;
  Workspace workspace_;
};

/// Plans all tasks, in changing orders.
class PriorityPlanner {
 public:
  PriorityPlanner(const Checker& checker, std::span<const ScheduleTask> tasks,
                  std::span<const ScheduledCurve> known, ConfigurationView still,
                  const SchedulePlanOptions& options)
      : checker_(checker),
        known_(known),
        options_(options),
        deadline_(Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                     std::chrono::duration<double>(options.seconds))),
        slice_(tasks.size() == 1 ? options.seconds
                                 : options.seconds / (4.0 * static_cast<double>(tasks.size()))),
        orders_(tasks.size()) {
    for (std::size_t i = 0; i < tasks.size(); ++i)
      own_.push_back(detail::readTask(checker, tasks[i], i));
    still_.assign(still.begin(), still.end());
    requireEachOnce(!still.empty());
  }

  PlannedSchedule run() {
    while (true) {
      if (std::optional<PlannedSchedule> done = tryOrders()) return *std::move(done);
      ++round_;
      // In every other round the first robot waits, longer each time. Between these, searches that
      // gave up may have needed more time.
      if (round_ % 2 == 0)
        slice_ *= 2.0;
      else
        wait_ = wait_ > 0.0 ? 2.0 * wait_ : kFirstWait * longestWay_;
    }
  }

 private:
  bool isLate() const { return options_.stop.stop_requested() || Clock::now() >= deadline_; }

  using Order = detail::PriorityOrders::Order;

  /// One round. No value: none of its orders gave a schedule, and the next round may.
  std::optional<PlannedSchedule> tryOrders() {
    orders_.beginRound();
    while (true) {
      const Order& order = orders_.current();
      ways_.assign(own_.size(), std::nullopt);
      const std::optional<std::size_t> failed = planInOrder(order);
      if (!failed) return finish(order);
      for (const std::optional<JointTrajectory>& way : ways_)
        if (way) longestWay_ = std::max(longestWay_, way->points.back().time);
      if (isLate() || own_.size() == 1 || isHopeless_) return std::move(found_);
      if (!goalsAreApart_ && goalsMeet(order)) return std::move(found_);
      if (failed == order.front()) slice_ *= 2.0;
      if (!orders_.next(*failed)) return std::nullopt;
    }
  }

  /// s. How long the robot of this task waits: only the first one does, in every other round.
  double waitOf(std::size_t task, const Order& order) const {
    return round_ % 2 == 1 && task == order.front() ? wait_ : 0.0;
  }

  /// Variables of tasks are in the checker's group, and in one task only. Others have a curve or
  /// stand still.
  void requireEachOnce(bool hasStill) {
    const Robot& robot = checker_.robot();
    const std::vector<int>& all = checker_.group().variables;
    if (!hasStill) still_.assign(all.size(), 0.0);
    requirePlan(still_.size() == all.size(), "the configuration has " +
                                                 std::to_string(still_.size()) +
                                                 " values, expected " + std::to_string(all.size()));
    std::set<std::string> taken;
    for (const OwnTask& own : own_) {
      for (std::size_t v = 0; v < own.names.size(); ++v) {
        const auto at = std::ranges::find(all, *robot.findVariable(own.names[v]));
        requirePlan(at != all.end(),
                    "group '" + checker_.group().name + "' has no variable '" + own.names[v] + "'");
        requirePlan(taken.insert(own.names[v]).second, "two tasks move '" + own.names[v] + "'");
        still_[static_cast<std::size_t>(at - all.begin())] =
            own.start[static_cast<Eigen::Index>(v)];
      }
    }
    for (const ScheduledCurve& curve : known_)
      taken.insert(curve.variables.begin(), curve.variables.end());
    for (const int variable : all) {
      const std::string& name = robot.variables()[static_cast<std::size_t>(variable)].name;
      requirePlan(hasStill || taken.contains(name), "nothing says where '" + name + "' is");
    }
  }

  /// The task that found no way, if one did not.
  std::optional<std::size_t> planInOrder(const Order& order) {
    for (std::size_t i = 0; i < order.size(); ++i) {
      const std::size_t task = order[i];
      const std::span later(order.begin() + static_cast<std::ptrdiff_t>(i) + 1, order.end());
      Way way = planOne(task, {}, waitOf(task, order));
      const bool startsApart = way.status != Status::StartNotFree;
      if (!way.trajectory && startsApart && !later.empty() && !isLate()) {
        std::vector<std::string> ignored;
        for (const std::size_t other : later)
          ignored.insert(ignored.end(), own_[other].names.begin(), own_[other].names.end());
        Way without = planOne(task, ignored, waitOf(task, order));
        isHopeless_ = i == 0 && without.status == Status::GoalNotFree;
        if (without.trajectory || isHopeless_) way = std::move(without);
      }
      isHopeless_ = isHopeless_ || (!startsApart && (i == 0 || startMeets(task)));
      if (!way.trajectory) {
        found_ = {
            .status = way.status, .task = task, .contact = std::move(way.contact), .order = order};
        return task;
      }
      ways_[task] = std::move(way.trajectory);
    }
    return std::nullopt;
  }

  /// Whether a task cannot even begin, whatever the other tasks do.
  bool startMeets(std::size_t task) const {
    const ScheduleChecker beside(checker_, own_[task].names, {known_.begin(), known_.end()},
                                 still_);
    Workspace workspace(beside.checker());
    return beside.certify(resting(own_[task].start), workspace).verdict == Verdict::Collision;
  }

  /// Whether two goals, each the only one of its task, cannot be taken at once. Says so.
  bool goalsMeet(const Order& order) {
    for (std::size_t a = 0; a < own_.size(); ++a) {
      for (std::size_t b = a + 1; b < own_.size(); ++b) {
        if (own_[a].goals.size() > 1 || own_[b].goals.size() > 1) continue;
        std::vector<std::string> ignored;
        for (std::size_t other = 0; other < own_.size(); ++other)
          if (other != a && other != b)
            ignored.insert(ignored.end(), own_[other].names.begin(), own_[other].names.end());
        const ScheduledCurve there{.variables = own_[a].names, .curve = resting(own_[a].goals[0])};
        const ScheduleChecker beside(checker_, own_[b].names, {there}, still_, ignored);
        Workspace workspace(beside.checker());
        const TrajectoryCertificate found = beside.certify(resting(own_[b].goals[0]), workspace);
        if (found.verdict != Verdict::Collision) continue;
        found_ = {.status = Status::GoalNotFree,
                  .task = b,
                  .contact = found.contact->witness,
                  .order = order};
        return true;
      }
    }
    goalsAreApart_ = true;
    return false;
  }

  std::vector<ScheduledCurve> curves() const {
    std::vector<ScheduledCurve> all(known_.begin(), known_.end());
    for (const std::optional<JointTrajectory>& way : ways_)
      if (way) all.push_back({.variables = way->variables, .curve = controllerCurve(*way)});
    return all;
  }

  bool asksForDelays() const { return options_.delay > 0.0 || options_.slowest > 1.0; }

  ///@{
  /// s, and a factor. With something to spare: at the end, certifyDelays() divides delays
  /// otherwise.
  double plannedDelay() const { return asksForDelays() ? 1.02 * options_.delay + 2e-3 : 0.0; }
  double plannedSlowest() const { return 1.0 + 1.02 * (options_.slowest - 1.0); }
  ///@}

  Way planOne(std::size_t task, const std::vector<std::string>& ignored, double wait) {
    const ScheduleChecker beside(checker_, own_[task].names, curves(), still_, ignored,
                                 plannedDelay(), plannedSlowest());
    const auto end = std::min(deadline_, Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                                            std::chrono::duration<double>(slice_)));
    const auto stop = [this, end] { return options_.stop.stop_requested() || Clock::now() >= end; };
    return WaySearch(beside, own_[task], options_, wait, stop).run();
  }

  PlannedSchedule finish(Order order) {
    const std::vector<ScheduledCurve> all = curves();
    PlannedSchedule result;
    result.curves.assign(all.begin() + std::ssize(known_), all.end());
    for (std::optional<JointTrajectory>& way : ways_)
      result.trajectories.push_back(*std::move(way));
    result.order = std::move(order);
    result.certificate = certifySchedule(checker_, all, {}, still_);
    bool isFree = result.certificate->verdict == Verdict::Free;
    for (std::size_t i = 0; isFree && asksForDelays() && i < all.size(); ++i) {
      result.delays.push_back(certifyDelays(
          checker_, all, {.curve = i, .latest = options_.delay, .slowest = options_.slowest},
          still_, options_.stop));
      isFree = result.delays.back().verdict == Verdict::Free;
    }
    result.status = isFree ? Status::Found : Status::NotProven;
    return result;
  }

  const Checker& checker_;
  const std::span<const ScheduledCurve> known_;
  const SchedulePlanOptions& options_;
  const Clock::time_point deadline_;
  double slice_;             ///< s, for one robot
  double wait_ = 0.0;        ///< s, of the first robot, in every other round
  double longestWay_ = 0.0;  ///< s, of all that were found
  std::size_t round_ = 0;
  std::vector<OwnTask> own_;
  detail::PriorityOrders orders_;
  std::vector<double> still_;
  std::vector<std::optional<JointTrajectory>> ways_;  ///< by task
  PlannedSchedule found_;                             ///< of the last failure
  bool isHopeless_ = false;                           ///< no other order can help
  bool goalsAreApart_ = false;                        ///< as far as is known: goalsMeet()
};

}  // namespace

PlannedSchedule planSchedule(const Checker& checker, std::span<const ScheduleTask> tasks,
                             std::span<const ScheduledCurve> known, ConfigurationView still,
                             const SchedulePlanOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&, tasks, known, still] { return planSchedule(checker, tasks, known, still, options); });
  }
  requirePlan(!tasks.empty(), "there is no task");
  requirePlan(
      std::isfinite(options.seconds) && options.seconds > 0.0,
      "seconds is " + detail::numberText(options.seconds) + "; allowed are finite numbers above 0");
  requirePlan(options.latest > 0.0, "latest is " + detail::numberText(options.latest) +
                                        " s; allowed are numbers above 0");
  requirePlan(
      std::isfinite(options.delay) && options.delay >= 0.0,
      "delay is " + detail::numberText(options.delay) + " s; allowed are finite numbers from 0 on");
  requirePlan(std::isfinite(options.slowest) && options.slowest >= 1.0,
              "slowest is " + detail::numberText(options.slowest) +
                  "; allowed are finite numbers from 1 on");
  requirePlan(options.improvements >= 0, "improvements is " + std::to_string(options.improvements) +
                                             "; allowed are 0 and more");
  return PriorityPlanner(checker, tasks, known, still, options).run();
}

const char* toString(PlannedSchedule::Status status) {
  switch (status) {
    case Status::Found:
      return "found";
    case Status::StartNotFree:
      return "start not free";
    case Status::GoalNotFree:
      return "goal not free";
    case Status::NotFound:
      return "not found";
    case Status::NotProven:
      return "not proven";
  }
  return "";
}

}  // namespace swept
