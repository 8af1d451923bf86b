// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "model.hpp"
#include "motion.hpp"

/// What a path keeps besides distances, at every instant. `constraints` of a path file has it.
namespace swept::verify {

/// A frame that is fixed in a link; link -1: in the model frame.
struct Frame {
  int link = -1;
  Eigen::Isometry3d link_from_frame = Eigen::Isometry3d::Identity();
};

/// A value of a joint is in [position - below, position + above], whole turns apart where `cyclic`.
/// 1e-5 more counts as within.
struct JointRange {
  std::size_t joint = 0;  ///< into Model::joints
  std::size_t value = 0;  ///< of a planar or floating joint: which
  bool cyclic = false;
  double position = 0.0, above = 0.0, below = 0.0;  ///< rad or m
};

/// The origin of `frame` is in one of the regions.
struct Regions {
  enum class Type : std::uint8_t { Box, Sphere, Cylinder };
  struct Region {
    Type type = Type::Box;
    /// m, may be infinite. Of a box the full sides; of a sphere the radius; of a cylinder, about z,
    /// radius and length.
    std::vector<double> size;
    Eigen::Isometry3d reference_from_region = Eigen::Isometry3d::Identity();
  };
  Frame frame, reference;
  std::vector<Region> regions;
};

/// R is the rotation of `frame`, seen from `reference`, behind the inverse of `desired`: Rx(a)
/// Ry(b) Rz(c) with |b| <= pi / 2, and |a|, |b|, |c| are at most `most`. Or, with `asVector`, the
/// rotation vector of R desired^-1 has no coordinate of more than `most`.
struct Turned {
  Frame frame, reference;
  Eigen::Quaterniond desired = Eigen::Quaterniond::Identity();
  Eigen::Vector3d most = Eigen::Vector3d::Zero();  ///< rad, may be infinite
  bool asVector = false;
};

/// An axis of `frame` is within an angle of a direction of `reference`.
struct Tilted {
  Frame frame, reference;
  Eigen::Vector3d axis, direction;  ///< unit
  double most = 0.0;                ///< rad, may be infinite
};

struct Constraint {
  std::string name;  ///< `axis of hand`: for messages
  std::string text;  ///< see Summary::constraints
  std::variant<JointRange, Regions, Turned, Tilted> what;
};

/// Reads `constraints` of a path file, a list. Throws Refusal.
std::vector<Constraint> readConstraints(const Json& list, const Model& model);

///@{
/// Parts of a constraint, and of lines. They throw Refusal, which starts with `where`.
///
/// 0 or more; null: infinity.
double readMost(const Json& json, const std::string& where);
/// For other keys than these: what is not read seems to mean something.
void requireKeys(const Json& json, const std::vector<std::string>& keys, const std::string& where);
Frame readFrame(const Json& json, const char* key, const Model& model, const std::string& where);
///@}

///@{
/// In words: with few digits and without a sign of zero; the link of a frame.
std::string briefText(double number);
std::string listText(const Eigen::Vector3d& numbers);
std::string nameOf(const Frame& frame, const Model& model);
///@}

/// Shows something at all times of a segment, from 0 to 1, and counts the intervals that it took.
/// `holds`: whether it is shown from middle - half to middle + half. The file has no planes for it:
/// intervals are halved until each is shown. Throws Refusal, which starts with `place`, where it
/// does not hold in the middle of an interval, or is not shown with a million of them.
std::size_t showByHalving(const std::function<bool(double middle, double half)>& holds,
                          const std::string& place);

/// Shows that a constraint holds at all times of a motion and wherever tolerances let the joints
/// be, as showByHalving() does.
std::size_t checkConstraint(const Model& model, const Motion& motion, const Constraint& constraint,
                            const std::string& place);

}  // namespace swept::verify
