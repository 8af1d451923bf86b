// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "swept/robot_model/collision_rules.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {

/// What is known about two links over all configurations within the limits of the joints between
/// them. Only Adjacent and Never are certain for all of them; MayCollide has a witness; samples
/// suggest Default and Always.
enum class PairStatus : std::uint8_t {
  Unknown,     ///< neither proven apart nor seen in contact within the budget or the time
  Adjacent,    ///< a joint connects the two; nothing else was tested
  Never,       ///< proven, rounding included: always more than the margin apart
  MayCollide,  ///< in contact at the witness, though not in the default state
  Default,     ///< in contact in the default state, but not at all samples
  Always,      ///< in contact in the default state and at all samples; rigidly attached: proven
};

/// `adjacent`, `never`, `may collide`, ...
std::string_view toString(PairStatus status);

/// What counts as contact, and how hard to look.
struct AllowedCollisionMatrixOptions {
  /// m. Contact means: at most this apart.
  double margin = 0.0;
  /// Work per pair of links: distances between balls; one on exact geometry counts as 100.
  std::int64_t budget = 20'000'000;
  /// Random configurations per pair of links that are tested before the proof.
  int samples = 1000;
  /// Seed of the random numbers. It changes only which witness is found, and whether a pair is
  /// Unknown or MayCollide, and Default or Always.
  std::uint32_t seed = 1;
  unsigned threads = 0;  ///< 0: as many as processors. Reports are the same for any number
  /// s. After this time, no pair is begun and no proof continued: see LinkPairReport::outOfTime.
  /// All pairs are tried with a small part of the budget first. Infinity: reports do not depend on
  /// the speed of the machine.
  double seconds = std::numeric_limits<double>::infinity();
  /// Receives the number of finished pairs and of all pairs; one call at a time, on any thread.
  std::function<void(std::size_t done, std::size_t all)> progress = {};
};

/// What is known about two links, over all values of the joints between them.
struct LinkPairReport {
  int linkA = -1;                           ///< index into Robot::links(), the smaller one
  int linkB = -1;                           ///< likewise, the larger one
  PairStatus status = PairStatus::Unknown;  ///< see PairStatus
  int joint = -1;  ///< for Adjacent: the joint that connects the two; else -1
  /// Robot variables that change the relative pose; none for links attached rigidly to each other.
  std::vector<int> variables;
  /// A configuration of all variables within their limits at which the two are in contact.
  /// Variables that are not in `variables` have their value in Robot::defaultState(). Present
  /// exactly for MayCollide, Default and Always. A Checker of all pairs finds the contact there;
  /// for two links attached rigidly to each other, only among its static contacts.
  std::optional<Eigen::VectorXd> witness;
  /// Share, by volume, of the box of joint values that is proven free of contact: 1 for Never, 0
  /// for Adjacent and if the proof was not tried.
  double proven = 0.0;
  std::int64_t effort = 0;  ///< spent of the budget
  bool outOfTime = false;   ///< Unknown because AllowedCollisionMatrixOptions::seconds ran out
  /// m. Least distance seen: the two come at least this near. It describes a pair that is Unknown.
  /// Infinity if none was computed.
  double nearest = std::numeric_limits<double>::infinity();
};

/// Reports on every pair of links with collision geometry, ordered by linkA, then linkB. All
/// variables count, also those of passive joints and outside any group; mimicking joints follow.
/// The SRDF's disabled pairs are ignored.
///
/// Never is proven by branch and bound over the box of the values of the joints between the two,
/// never by samples. The box has the limits, and tolerance::kLimit beyond, since Checker answers
/// for such values as they are; a joint without limits, or that can do a whole turn, has one turn.
/// Nothing can be proven in these cases, and the pair is Unknown unless samples find a contact: a
/// planar or floating joint between the two; a joint that follows a joint without limits by a
/// factor that is no integer; limits beyond 1000 rad or m, unless they span a turn. Throws
/// std::invalid_argument for a margin that is negative or not finite, a negative budget or number
/// of samples, and seconds that are not above 0.
std::vector<LinkPairReport> computeAllowedCollisionMatrix(
    const Robot& robot, const AllowedCollisionMatrixOptions& options = {});

/// The reason of each of the rules below.
inline constexpr std::string_view kDefaultContact =
    "in contact at the default state and at all others that were looked at";

/// Pairs of links in contact at Robot::defaultState(). Without an SRDF, they put a robot in
/// collision, often in every state. Links that a joint connects, and links attached rigidly to each
/// other, are not included.
struct DefaultContacts {
  /// Allows the pairs that are in contact at 1000 random states, too (Always in
  /// computeAllowedCollisionMatrix). Use them only on request: put them below the other rules
  /// (CollisionRules::over), and tell the user which they are.
  CollisionRules always;
  /// Names of the other pairs. They can part, so leaving them out would prove less than asked.
  std::vector<std::pair<std::string, std::string>> sometimes;
};
/// See DefaultContacts. For a robot with more than 150 links `always` is empty: all its pairs stay
/// checked.
DefaultContacts defaultContacts(const Robot& robot);

/// An SRDF that disables the pairs that are Adjacent, Never, Always or Default, with these words as
/// reasons, in the order of the reports.
///
/// If `srdfText` is empty, it is a new one without groups. Otherwise it is that text, byte for
/// byte, except for its `disable_collisions` elements. The new ones replace them where the first
/// one stands (before the end of `robot` if there is none). Elements that name a link the robot
/// lacks stay, and pairs that an `enable_collisions` names are left out. Messages call the text
/// `srdfName`. Throws InputError if the text is no SRDF.
std::string srdfWithPairs(const Robot& robot, std::span<const LinkPairReport> pairs,
                          const std::string& srdfText = {}, const std::string& srdfName = {});

}  // namespace swept
