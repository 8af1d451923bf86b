// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "swept/core/verdict.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/configuration.hpp"

namespace swept {

namespace detail {
struct ProvenGraphData;
}

/// States, and straight motions between them, each with what is proven of it: the edges of a
/// roadmap. When the world changes, only motions that the change can reach are asked about again.
///
/// Of each motion it keeps boxes around what each piece of the robot sweeps in each sixteenth of
/// it, and the bodies of the world that it is not proven to keep its margin from. A motion is Free
/// if there are none. So the verdict is known body by body:
/// * a body that is gone blocks nothing any more, and proves nothing wrong;
/// * a new body changes nothing where it touches no box of a motion, grown by the margin and by
///   all roundings: they are proven to stay apart by comparing numbers;
/// * every other motion is asked about this body alone: its pieces and parts whose boxes touch it.
///
/// A motion in contact with the robot itself, or not keeping the constraints, does not depend on
/// the world. It is never added.
class ProvenGraph {
 public:
  /// A motion between two states, by their indices. It is proven in both directions: they pass the
  /// same configurations.
  struct Motion {
    std::uint32_t from = 0;  ///< index of a state
    std::uint32_t to = 0;    ///< likewise
  };
  /// What update() did.
  struct Change {
    std::size_t bodiesGone = 0;    ///< removed, or not what they were
    std::size_t bodiesNew = 0;     ///< added, or not what they were
    std::size_t byArithmetic = 0;  ///< pairs of a motion and a new body that touches no box of it
    std::size_t asked = 0;         ///< the other pairs, which a Checker was asked about
    std::size_t motionsAsked = 0;  ///< motions that a Checker was asked about
    std::size_t freed = 0;         ///< motions that are Free and were not
    std::size_t blocked = 0;       ///< motions that were Free and are not
    /// More than the world has changed, so all motions were asked about anew.
    bool everything = false;
    bool stopped = false;  ///< before it was done: nothing has changed
  };

  /// Without states. Throws std::invalid_argument for null and for a world with moving obstacles,
  /// beside which a motion depends on the time.
  explicit ProvenGraph(std::shared_ptr<const Checker> checker);
  ///@{
  /// Copies share nothing that changes: a planner may go on with one while another is updated.
  ProvenGraph(const ProvenGraph& other);
  ProvenGraph& operator=(const ProvenGraph& other);
  ProvenGraph(ProvenGraph&&) noexcept;
  ProvenGraph& operator=(ProvenGraph&&) noexcept;
  ~ProvenGraph();
  ///@}

  /// Of the current world.
  const std::shared_ptr<const Checker>& checker() const;
  std::size_t states() const;   ///< how many
  std::size_t motions() const;  ///< how many
  /// rad, m. Valid until a state is added.
  ConfigurationView state(std::size_t index) const;
  const Motion& motion(std::size_t index) const;  ///< valid until motions are added
  bool isFree(std::size_t motion) const;          ///< the motion is proven in the current world
  /// Of the motion, in the current world. Collision where it meets a body; Undecided where it is
  /// proven neither to meet one nor to keep all margins.
  Verdict verdict(std::size_t motion) const;
  /// Names of the bodies that keep the motion from being Free, in no particular order.
  std::vector<std::string> blockedBy(std::size_t motion) const;

  /// Returns the index. Throws std::invalid_argument for a state of another size than a
  /// configuration, and for values that are not finite.
  std::uint32_t addState(ConfigurationView q);
  /// Asks about these motions, on up to `threads` threads (0: as many as processors), and adds
  /// those that are Free in a world without bodies, in this order. Left out are also motions of a
  /// cyclic value by half a turn, which do not go the same way back. Once `stop` is requested, by
  /// any thread, it asks nothing more, and adds those that are proven by then. Returns how many
  /// were added. Throws std::invalid_argument for an index that is no state's.
  std::size_t addMotions(std::span<const Motion> motions, unsigned threads = 1,
                         const std::stop_token& stop = {});

  /// Takes a checker of the same robot in another world: the verdicts are then those in that world.
  /// Which bodies have changed it finds by itself. If anything else differs (margins, rules that
  /// name none of the bodies, what is attached, the constraints), it asks about everything, and
  /// motions are left out that are no longer Free in a world without bodies. Once `stop` is
  /// requested, by any thread, it asks nothing more (Change::stopped). Throws std::invalid_argument
  /// for another robot or group, and as the constructor does; then nothing has changed.
  Change update(std::shared_ptr<const Checker> changed, unsigned threads = 1,
                const std::stop_token& stop = {});

  /// Writes a file (JSON): states, motions, what blocks them, and hashes of the robot, of the
  /// checker's options, and of each body of the world. Throws UsageError if it cannot be written,
  /// or would be larger than what load() reads.
  void save(const std::filesystem::path& file) const;
  /// Reads a file of save(). Nothing is asked: verdicts are those of the file, boxes are made anew.
  /// It finds out damage, and any change of the robot, the options or the world, but not forgery:
  /// who can write the file can write verdicts. Throws InputError for a file that is none of
  /// save()'s, damaged, or of another robot, group, option or world than the checker's, naming what
  /// differs; and as the constructor does.
  static ProvenGraph load(const std::filesystem::path& file, std::shared_ptr<const Checker> checker,
                          unsigned threads = 1);
  struct Updated;
  /// The same for a checker of another world: what load() in the file's world and update() give.
  /// Throws likewise, but not for another world.
  static Updated loadChanged(const std::filesystem::path& file,
                             std::shared_ptr<const Checker> checker, unsigned threads = 1);

 private:
  std::unique_ptr<detail::ProvenGraphData> data_;
};

/// A graph, and what update() did with it.
struct ProvenGraph::Updated {
  ProvenGraph graph;  ///< in the world of the checker
  Change change;      ///< from the world of the file
};

}  // namespace swept
