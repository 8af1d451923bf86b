// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/piecewise_polynomial.hpp"
#include "swept/robot_model/trajectory_certificate.hpp"
#include "swept/robot_model/visual_model.hpp"

/// An HTML page with a robot, its world, and what is proven about its states and motions.
namespace swept {

/// Texts of a page besides what it computes. Any text is allowed: it is escaped, not markup.
struct PageOptions {
  std::string title = "swept";  ///< above the headline, with the robot's name
  std::string headline;         ///< empty: how many of the states or motions are free
  std::vector<std::pair<std::string, std::string>>
      facts;                 ///< name and value, before the page's own
  VisualModel visuals = {};  ///< what the robot looks like; empty: not read
};

/// A page: one HTML file that any browser opens from disk, without network. It shows states one at
/// a time, or motions one after the other, or paths or trajectories one at a time. The checker
/// judges each when it is added; verdicts, contacts and distances are the checker's. Its
/// constraints are named, with their values at the moment shown. Poses are drawn in single
/// precision.
///
/// Only one thread at a time may use a page.
class Page {
 public:
  /// Keeps the checker as long as the page lives. Throws std::invalid_argument for null.
  explicit Page(std::shared_ptr<const Checker> checker, PageOptions options = {});
  ~Page();
  Page(Page&&) noexcept;
  Page& operator=(Page&&) noexcept;

  ///@{
  /// Adds a state, motion or path. `label`: its name on the page. Configurations have a value for
  /// each variable of the checker's group, m or rad, and beside moving obstacles the time, s, on
  /// their clock: they are shown where they are by then. A path of a single state stays there.
  /// Throws std::invalid_argument for another number of values, a non-finite value, another kind
  /// than was added before, and a path without a state.
  void addState(const std::string& label, std::span<const double> state);
  void addMotion(const std::string& label, std::span<const double> from,
                 std::span<const double> to);
  void addPath(const std::string& label, std::span<const std::vector<double>> states);
  ///@}
  /// Adds a curve in time, which the page plays in real time, with plots of its values and rates.
  /// The page shows the limits of positions and of `query`, the tube of CheckerOptions::tracking,
  /// and the clearance of each of up to 96 equal parts, proven for the curve itself, without its
  /// tube. `polyline`: configurations that the curve was made from, shown beside it as straight
  /// motions. Moving obstacles are shown where they are at TrajectoryQuery::clock plus the time.
  ///
  /// Throws std::invalid_argument as addPath(), where configurations have no time, as
  /// Checker::certifyTrajectory(), and for an orientation with a quaternion of zero.
  void addTrajectory(const std::string& label, const PiecewisePolynomial& curve,
                     const TrajectoryQuery& query = {},
                     std::span<const std::vector<double>> polyline = {});

  /// The whole file. Takes about the time of a hundred states and 24 motions for each motion, and
  /// of clearances over all of each trajectory. Throws std::invalid_argument if nothing was added.
  std::string html() const;
  /// Writes html() to a file, completely or not at all. Throws UsageError for an extension other
  /// than .html or .htm and for a file that cannot be written.
  void write(const std::filesystem::path& file) const;

 private:
  friend class TaskPage;
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace swept
