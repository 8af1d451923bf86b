// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/visual_model.hpp"

/// A robot, its world, and what is proven about its states and motions, for a browser.
namespace swept {

/// What a page says besides what it computes. Any text will do: none of it can be markup.
struct PageOptions {
  std::string title = "swept";  ///< stands above the headline, with the robot's name
  std::string headline;         ///< empty: how many of what is shown are free
  std::vector<std::pair<std::string, std::string>>
      facts;                 ///< name and value, before the page's own
  VisualModel visuals = {};  ///< what the robot looks like; empty: nobody has read it
};

/// A page: one HTML file that any browser opens from disk, without network. It has either states,
/// shown one at a time, or motions, played one after the other, or paths, of which one is shown at
/// a time. Each is judged by the checker when it is added; the verdict, contacts and distances are
/// what the checker says, and poses are drawn in single precision.
///
/// A page is of one thread at a time.
class Page {
 public:
  /// Keeps the checker for as long as it is there. Throws std::invalid_argument for none.
  explicit Page(std::shared_ptr<const Checker> checker, PageOptions options = {});
  ~Page();
  Page(Page&&) noexcept;
  Page& operator=(Page&&) noexcept;

  ///@{
  /// `label`: what the page calls it. Configurations have a value for each variable of the
  /// checker's group, m or rad. Throws std::invalid_argument for another number of values, for a
  /// value that is not finite, for what is of another kind than what was added before, and for a
  /// path without a state; one of a single state stays there.
  void addState(const std::string& label, std::span<const double> state);
  void addMotion(const std::string& label, std::span<const double> from,
                 std::span<const double> to);
  void addPath(const std::string& label, std::span<const std::vector<double>> states);
  ///@}

  /// The whole file. Takes about the time of a hundred states and 24 motions for each motion.
  /// Throws std::invalid_argument where nothing was added.
  std::string html() const;
  /// The same to a file, which appears whole or not at all. Throws UsageError for an ending other
  /// than .html or .htm and for a file that cannot be written.
  void write(const std::filesystem::path& file) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace swept
