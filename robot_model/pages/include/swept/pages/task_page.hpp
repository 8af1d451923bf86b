// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "swept/pages/page.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/piecewise_polynomial.hpp"
#include "swept/robot_model/trajectory_certificate.hpp"

namespace swept {

/// A page that plays a task on one clock: trajectories one after the other, each with its own
/// group, world and attached bodies. One HTML file that any browser opens from disk, without
/// network. Each phase is shown as Page shows a trajectory, with its checker's answers, and the
/// camera stays where it is from one to the next.
///
/// The page does not say whether the phases join: `swept verify` does, of a file of writeTask().
/// Only one thread at a time may use a page.
class TaskPage {
 public:
  /// `options` are those of the page of each phase; a headline is that of the whole.
  explicit TaskPage(PageOptions options = {});
  ~TaskPage();
  TaskPage(TaskPage&&) noexcept;
  TaskPage& operator=(TaskPage&&) noexcept;

  /// Adds a phase, whose curve begins where the one before ended. `changes`: what has changed since
  /// then, for people: `cup attached to hand`. Moving obstacles are shown where they are at
  /// TrajectoryQuery::clock plus the time. Throws std::invalid_argument as Page::addTrajectory()
  /// does, for null, and for a curve that begins earlier than the one before ends.
  void addPhase(const std::string& label, std::shared_ptr<const Checker> checker,
                const PiecewisePolynomial& curve, const TrajectoryQuery& query = {},
                const std::vector<std::string>& changes = {});

  /// The whole file. Throws std::invalid_argument if nothing was added.
  std::string html() const;
  /// Writes html() to a file, as Page::write() does.
  void write(const std::filesystem::path& file) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace swept
