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
/// them. Only Adjacent and Never are certain for all of them; MayCollide has a witness; Default and
/// Always are what samples suggest.
enum class PairStatus : std::uint8_t {
  Unknown,     ///< neither proven apart nor seen in contact within the budget or the time
  Adjacent,    ///< a joint connects the two; nothing else was looked at
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
  /// Random configurations per pair of links that are looked at before anything is proven.
  int samples = 1000;
  /// Of the random numbers. Reports depend on it only in which witness is found, in Unknown against
  /// MayCollide, and in Default against Always.
  std::uint32_t seed = 1;
  unsigned threads = 0;  ///< 0: as many as there are processors. Reports are the same on any number
  /// s. No pair is begun, nor a proof gone on with, after so long: see LinkPairReport::outOfTime.
  /// All pairs are tried with a small part of the budget first. Infinity: reports do not depend on
  /// how fast the machine is.
  double seconds = std::numeric_limits<double>::infinity();
  /// Told how many pairs of how many are done with, one call at a time, on any thread.
  std::function<void(std::size_t done, std::size_t all)> progress = {};
};

/// What is known about two links, over all values of the joints between them.
struct LinkPairReport {
  int linkA = -1;                           ///< index into Robot::links(), the smaller one
  int linkB = -1;                           ///< likewise, the larger one
  PairStatus status = PairStatus::Unknown;  ///< see PairStatus
  int joint = -1;  ///< under Adjacent: the joint that connects the two; else -1
  /// Robot variables that change the relative pose; none for links attached rigidly to each other.
  std::vector<int> variables;
  /// A configuration of all variables within their limits at which the two are in contact; those
  /// not in `variables` have their value in Robot::defaultState(). Engaged exactly for MayCollide,
  /// Default and Always. A Checker of all pairs finds the contact there; that of two links attached
  /// rigidly to each other among its standing contacts alone.
  std::optional<Eigen::VectorXd> witness;
  /// Share, by volume, of the box of joint values that is proven free of contact: 1 under Never, 0
  /// under Adjacent and where the proof was not tried.
  double proven = 0.0;
  std::int64_t effort = 0;  ///< spent of the budget
  bool outOfTime =
      false;  ///< Unknown, and AllowedCollisionMatrixOptions::seconds were over: more time may tell
  /// m. Least distance seen, to tell a pair that is Unknown: the two come at least so near.
  /// Infinity where none was computed.
  double nearest = std::numeric_limits<double>::infinity();
};

/// Every pair of links with collision geometry, ordered by linkA, then linkB. All variables count,
/// passive joints' and those outside any group too; mimicking joints follow. The SRDF's disabled
/// pairs are not looked at.
///
/// Never is proven by branch and bound over the box of the values of the joints between the two
/// (limits, and tolerance::kLimit beyond, since Checker answers for such values as they are; one
/// turn of what can do one or has no limits), never by samples. With a planar or floating joint
/// between them, a joint that follows a joint without limits by a factor that is no integer, or,
/// where not a turn is done, limits beyond 1000 rad or m, nothing can be proven, and the pair is
/// Unknown unless samples find a contact. Throws std::invalid_argument for a margin that is
/// negative or not finite, a negative budget or number of samples, and seconds that are not above
/// 0.
std::vector<LinkPairReport> computeAllowedCollisionMatrix(
    const Robot& robot, const AllowedCollisionMatrixOptions& options = {});

/// The reason of each of the rules below.
inline constexpr std::string_view kDefaultContact =
    "in contact at the default state and at all others that were looked at";

/// Pairs of links in contact at Robot::defaultState(): what a robot without an SRDF is in collision
/// with, often in every state. Links that a joint connects, and links attached rigidly to each
/// other, are not among them.
struct DefaultContacts {
  /// Allow those that are in contact at 1000 random states, too (Always, as
  /// computeAllowedCollisionMatrix finds them). For whoever asks for them: put them below the other
  /// rules (CollisionRules::over), and say which they are.
  CollisionRules always;
  /// Names of the others. They can be apart, so that leaving them out would prove less than asked.
  std::vector<std::pair<std::string, std::string>> sometimes;
};
/// See DefaultContacts. Of a robot with more than 150 links none: all its pairs stay checked.
DefaultContacts defaultContacts(const Robot& robot);

/// An SRDF that disables the pairs that are Adjacent, Never, Always or Default, with these words
/// as reasons, in the order of the reports.
///
/// With `srdfText` empty, a new one without groups. Else that text, byte for byte, but for its
/// `disable_collisions` elements, which the new ones replace where the first one stands (before
/// `robot` ends if there is none); those that name a link the robot does not have stay, and pairs
/// that an `enable_collisions` names are left out. `srdfName` is what messages call the text.
/// Throws InputError when it is no SRDF.
std::string srdfWithPairs(const Robot& robot, std::span<const LinkPairReport> pairs,
                          const std::string& srdfText = {}, const std::string& srdfName = {});

}  // namespace swept
