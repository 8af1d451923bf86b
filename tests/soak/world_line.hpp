// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <random>

#include "stage.hpp"
#include "swept/ompl_bridge/motion_validator.hpp"
#include "swept/ompl_bridge/validity_checker.hpp"

namespace soak {

/// A checker with all that is to be known about the world it stands for.
struct Version {
  Version(const Stage& stage, WorldKey key, const swept::Checker& checker);

  const Stage& stage;
  WorldKey key;
  std::shared_ptr<const swept::Checker> checker;
  ompl::base::SpaceInformationPtr information;
  swept::ValidityChecker validity;
  swept::CertifiedMotionValidator motions;
};

struct UpdateCounts {
  std::int64_t added = 0, removed = 0, replaced = 0, returned = 0;
  std::int64_t all() const { return added + removed + replaced + returned; }
  void add(const UpdateCounts& other) {
    added += other.added;
    removed += other.removed;
    replaced += other.replaced;
    returned += other.returned;
  }
};

/// The world of a stage as it changes: each change makes a new version, and whoever asks an earlier
/// one keeps it for as long as that takes.
class WorldLine {
 public:
  WorldLine(const Stage& stage, std::uint64_t seed);

  const Stage& stage() const { return stage_; }
  /// Any thread may call it.
  std::shared_ptr<const Version> current() const;

  /// What follows is for one thread. A body is added, taken away, or replaced by another form of it
  /// elsewhere; or the world is again one that it was before.
  void update();
  const UpdateCounts& counts() const { return counts_; }

 private:
  struct Earlier {
    WorldKey key;
    std::shared_ptr<const swept::World> world;
  };
  int uniform(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
  void publish(WorldKey key, const swept::Checker& checker);
  void add(const Version& from);
  void remove(const Version& from);
  void replace(const Version& from);
  void goBack(const Version& from);

  const Stage& stage_;
  std::mt19937_64 random_;
  UpdateCounts counts_;
  std::array<Earlier, 8> earlier_;
  mutable std::mutex mutex_;                ///< guards the pointer below
  std::shared_ptr<const Version> current_;  ///< never null
};

}  // namespace soak
