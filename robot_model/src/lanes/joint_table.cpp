// SPDX-License-Identifier: BSD-3-Clause
#include "lanes/joint_table.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "certify/checker_model.hpp"
#include "swept/core/distance.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// Along each joint, of a table for one and for two.
constexpr std::array<int, 3> kCells{1, 1024, 192};
/// Distances of balls evaluated for one table; one that would take more is not built. Some 10 ns
/// each.
constexpr int kMostWork = 4'000'000;
/// m. Cells in which points travel more than this are not compared exactly; one such comparison
/// counts as many of balls, and each of its steps too.
constexpr double kExactTravel = 0.02;
constexpr int kExactWork = 50;
constexpr int kStepWork = 8;
/// A table is not worth its time for bodies that are not apart, or only just, in so large a share
/// of their range: a contact, where nothing else is.
constexpr double kMostOpen = 0.7;
constexpr int kProbes = 6;
/// rad. Single precision tells cells apart on ranges up to this.
constexpr double kWidest = 32.0;
/// rad; values are known this well.
constexpr double kValueRounding = 1e-5;

bool turns(JointType type) {
  return type == JointType::Revolute || type == JointType::Continuous;
}

class TableBuilder {
 public:
  TableBuilder(const CheckerModel& model, const LaneModel& lanes, const LaneBodyPair& bodies)
      : model_(model), lanes_(lanes), bodies_(bodies) {}

  /// Null if there is none. Takes what it costs from the budget.
  std::shared_ptr<const JointTable> build(int& budget) {
    const int reference = lanes_.references[bodies_.reference].body;
    collect(bodies_.bodyA, reference, pathA_);
    collect(bodies_.bodyB, reference, pathB_);
    path_ = pathA_;
    path_.insert(path_.end(), pathB_.begin(), pathB_.end());
    if (path_.empty() || path_.size() > JointTable::kMostJoints || !setAxes()) return nullptr;
    table_.cells.resize(static_cast<std::size_t>(table_.axes[0].cells * table_.axes[1].cells));
    slack_ = model_.options.margin + 1e-5 * static_cast<double>(lanes_.reach);
    collectPairs();
    work_ = std::min(kMostWork, budget);
    const int given = work_;
    bool built = !isMostlyOpen();
    for (std::size_t i = 0; i < table_.pairs.size() && built; ++i) {
      choose(i);
      prove({{0, 0}, {table_.axes[0].cells, table_.axes[1].cells}}, roots());
      built = work_ > 0;
    }
    budget -= given - std::max(0, work_);
    if (!built) return nullptr;
    sum();
    return std::make_shared<const JointTable>(std::move(table_));
  }

 private:
  struct Cells {
    std::array<int, 2> begin;
    std::array<int, 2> end;
  };
  struct Balls {
    std::int32_t a;
    std::int32_t b;
  };

  void collectPairs() {
    for (const LanePairSource& pair : lanes_.sources)
      if (pair.obstacle < 0 && &lanes_.bodyPairs[pair.bodyPair] == &bodies_)
        table_.pairs.push_back({pair.geometry, pair.other});
  }

  /// The pair that is looked at from now on.
  void choose(std::size_t pair) {
    bit_ = static_cast<std::uint8_t>(1U << std::min(pair, JointTable::kPairBits - 1));
    geometryA_ = table_.pairs[pair].a;
    geometryB_ = table_.pairs[pair].b;
    stopped_ = {-1, -1};
  }

  Balls roots() const {
    return {lanes_.rootOfGeometry[geometryA_], lanes_.rootOfGeometry[geometryB_]};
  }

  /// By single cells, evenly over the range.
  bool isMostlyOpen() {
    int open = 0;
    int probes = 0;
    for (int i = 0; i < kProbes; ++i) {
      for (int j = 0; j < (table_.joints == 2 ? kProbes : 1); ++j) {
        const int row = (2 * i + 1) * table_.axes[0].cells / (2 * kProbes);
        const int column = (2 * j + 1) * table_.axes[1].cells / (2 * kProbes);
        const Place place = placeOf({{row, column}, {row + 1, column + 1}});
        ++probes;
        for (std::size_t pair = 0; pair < table_.pairs.size(); ++pair) {
          choose(pair);
          if (apart(place, travel(place), roots())) continue;
          ++open;
          break;
        }
      }
    }
    return open > kMostOpen * probes;
  }

  void collect(int body, int reference, std::vector<int>& path) const {
    for (; body != reference && body > 0; body = model_.kinematics.bodies[body].parent)
      path.push_back(body);
    std::ranges::reverse(path);
  }

  bool setAxes() {
    for (std::size_t k = 0; k < path_.size(); ++k) {
      const MovingBody& body = model_.kinematics.bodies[path_[k]];
      double lower = body.lower;
      double upper = body.upper;
      // A full turn is all there is.
      if (body.type == JointType::Continuous) {
        upper = std::numbers::pi;
        lower = -upper;
      }
      const bool fits = turns(body.type) && lower >= -kWidest && upper <= kWidest && upper > lower;
      if (!fits) return false;
      JointTable::Axis& axis = table_.axes[k];
      axis.body = path_[k];
      axis.lower = static_cast<float>(lower);
      axis.upper = static_cast<float>(upper);
      axis.cells = kCells[path_.size()];
      axis.cellsPerUnit = static_cast<float>(axis.cells / (upper - lower));
      low_[k] = lower - kValueRounding;
      step_[k] = (upper - lower + 2.0 * kValueRounding) / axis.cells;
    }
    table_.joints = static_cast<int>(path_.size());
    return true;
  }

  Isometry3d pose(std::span<const int> path, std::span<const double> values) const {
    Isometry3d result = Isometry3d::Identity();
    for (std::size_t i = 0; i < path.size(); ++i) {
      const MovingBody& body = model_.kinematics.bodies[path[i]];
      result = result * body.parent_from_joint;
      result.rotate(Eigen::AngleAxisd(values[i], body.axis));
    }
    return result;
  }

  struct Place {
    Isometry3d bodies;             ///< A's frame from B's, as the kinematics has them
    Isometry3d a_from_b;           ///< between the frames that the balls are in
    std::array<double, 2> half{};  ///< rad
  };
  Place placeOf(const Cells& cells) const {
    std::array<double, 2> middle{};
    Place place;
    for (std::size_t k = 0; k < path_.size(); ++k) {
      middle[k] = low_[k] + 0.5 * step_[k] * (cells.begin[k] + cells.end[k]);
      // A cell more than it is: what a float can be off is far less.
      place.half[k] = 0.5 * step_[k] * (cells.end[k] - cells.begin[k]) + 4.0 * kValueRounding;
    }
    const std::span<const double> values(middle);
    place.bodies = pose(pathA_, values.first(pathA_.size())).inverse() *
                   pose(pathB_, values.subspan(pathA_.size(), pathB_.size()));
    place.a_from_b = lanes_.bodyFromLane[bodies_.bodyA].transpose() * place.bodies;
    place.a_from_b.rotate(lanes_.bodyFromLane[bodies_.bodyB]);
    return place;
  }

  static Vector3d center(const LaneNode& node) {
    return {node.center[0], node.center[1], node.center[2]};
  }

  /// m; how far the centres may come from where they are in the middle of the cells, relative to
  /// each other: the sum of the half widths times distances from the axes, here bounded by those
  /// over all values of the joints beyond.
  double travel(const Place& place) const {
    const LaneReference& reference = lanes_.references[bodies_.reference];
    double sum = 0.0;
    for (std::size_t k = 0; k < path_.size(); ++k) {
      const int slot = reference.slot[k < pathA_.size() ? bodies_.bodyA : bodies_.bodyB];
      const int step = reference.slot[path_[k]];
      const Row& row = reference.arms[step * reference.rows + slot / kLanes];
      sum += place.half[k] * static_cast<double>(row.lane[slot % kLanes]);
    }
    return sum;
  }

  /// False as soon as two balls that are fine against the travel are not proven apart; `stopped_`
  /// are these.
  bool apart(const Place& place, double travel, const Balls& balls) {
    --work_;
    const LaneNode& a = lanes_.nodes[balls.a];
    const LaneNode& b = lanes_.nodes[balls.b];
    const double between = (place.a_from_b * center(b) - center(a)).norm();
    if (between - static_cast<double>(a.radius) - static_cast<double>(b.radius) - slack_ > travel)
      return true;
    const bool solid = a.inside > 0.0F && b.inside > 0.0F;
    const double overlap = static_cast<double>(a.inside + b.inside) - between - slack_;
    if (solid && overlap > meeting_) {
      meeting_ = overlap;
      meetingBalls_ = balls;
    }
    if (solid && overlap > travel) {
      stopped_ = balls;
      return false;
    }
    const bool splitA = a.childCount > 0 && (b.childCount == 0 || a.radius >= b.radius);
    const LaneNode& parent = splitA ? a : b;
    const bool fine = static_cast<double>(a.beyond + b.beyond) < 0.5 * travel;
    if (parent.childCount == 0 || fine || work_ <= 0) {
      stopped_ = balls;
      return false;
    }
    for (std::int32_t i = 0; i < parent.childCount; ++i) {
      const Balls child =
          splitA ? Balls{parent.firstChild + i, balls.b} : Balls{balls.a, parent.firstChild + i};
      if (!apart(place, travel, child)) return false;
    }
    return true;
  }

  /// The balls inside the two links that overlap most.
  void findMeeting(const Place& place) {
    const LaneModel::InnerBalls& ofA = lanes_.innerBalls[geometryA_];
    const LaneModel::InnerBalls& ofB = lanes_.innerBalls[geometryB_];
    for (std::int32_t b = ofB.first; b < ofB.first + ofB.count; ++b) {
      const Vector3d at = place.a_from_b * center(lanes_.nodes[b]);
      for (std::int32_t a = ofA.first; a < ofA.first + ofA.count; ++a) {
        const double reach = static_cast<double>(lanes_.nodes[a].inside + lanes_.nodes[b].inside);
        const double overlap = reach - (at - center(lanes_.nodes[a])).norm() - slack_;
        if (overlap <= meeting_) continue;
        meeting_ = overlap;
        meetingBalls_ = {a, b};
      }
    }
  }

  /// m; like `travel`, of any point of the geometry.
  double travelOfPoints(const Place& place) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < path_.size(); ++k) {
      const int geometry = k < pathA_.size() ? geometryA_ : geometryB_;
      const LeverArms& levers = model_.robotGeometry[geometry].levers;
      const auto at = std::ranges::find(levers.path, path_[k]) - levers.path.begin();
      sum += place.half[k] * levers.arms[static_cast<std::size_t>(at)];
    }
    return sum;
  }

  /// The same by the exact geometry, which is worth its time only where the covers fail by little.
  bool apartExactly(const Place& place, bool single) {
    const double most = travelOfPoints(place) * (1.0 + 1e-9) + slack_;
    touching_ = false;
    compared_ = most <= kExactTravel;
    if (!compared_) return false;
    const RobotGeometry& a = model_.robotGeometry[geometryA_];
    const RobotGeometry& b = model_.robotGeometry[geometryB_];
    DistanceOptions options;
    options.enough = most;
    // Whether there is contact in the middle is of interest only where it is kept.
    options.contact = single ? model_.options.margin : most;
    options.tolerance = 0.1 * most;
    const DistanceResult found = distance(
        a.shape, b.shape, a.body_from_shape.inverse() * place.bodies * b.body_from_shape, options);
    work_ -= kExactWork + kStepWork * found.iterations;
    touching_ = single && found.upper <= model_.options.margin;
    return found.lower > most;
  }

  /// By halves of the cells, as far as that takes. Where the last ones were stopped is where the
  /// next are likely to be.
  void prove(const Cells& cells, const Balls& balls) {
    const Place place = placeOf(cells);
    const double most = travel(place) * (1.0 + 1e-9);
    const Balls last = stopped_;
    meeting_ = 0.0;
    if ((last.a < 0 || apart(place, most, last)) && apart(place, most, balls)) return;
    // Where balls in the links meet for all values of the joints, there is nothing to prove.
    if (meeting_ > most) touching_ = true;
    if (meeting_ > most || haveMeetings(cells)) return leaveOpen(cells);
    const bool single = cells.end[0] - cells.begin[0] == 1 && cells.end[1] - cells.begin[1] == 1;
    if (apartExactly(place, single)) return;
    if (single || work_ <= 0) {
      // Where the middle is known to be free of contact no balls meet.
      if (touching_ || !compared_) findMeeting(place);
      return leaveOpen(cells);
    }
    const int widest = cells.end[0] - cells.begin[0] >= cells.end[1] - cells.begin[1] ? 0 : 1;
    const int middle = (cells.begin[widest] + cells.end[widest]) / 2;
    Cells half = cells;
    half.end[widest] = middle;
    prove(half, balls);
    half = cells;
    half.begin[widest] = middle;
    prove(half, balls);
  }

  /// A contact in all of them is known already.
  bool haveMeetings(const Cells& cells) const {
    for (int i = cells.begin[0]; i < cells.end[0]; ++i)
      for (int j = cells.begin[1]; j < cells.end[1]; ++j)
        if (table_.cells[i * table_.axes[1].cells + j].nodeA < 0) return false;
    return true;
  }

  void leaveOpen(const Cells& cells) {
    for (int i = cells.begin[0]; i < cells.end[0]; ++i) {
      for (int j = cells.begin[1]; j < cells.end[1]; ++j) {
        JointTable::Cell& cell = table_.cells[i * table_.axes[1].cells + j];
        cell.openPairs |= bit_;
        cell.touching = cell.touching || touching_;
        if (!(meeting_ > 0.0) || cell.nodeA >= 0) continue;
        cell.nodeA = meetingBalls_.a;
        cell.nodeB = meetingBalls_.b;
      }
    }
  }

  void sum() {
    const int rows = table_.axes[0].cells;
    const int columns = table_.axes[1].cells;
    table_.open.assign(static_cast<std::size_t>((rows + 1) * (columns + 1)), 0);
    for (int i = 0; i < rows; ++i) {
      std::uint32_t line = 0;
      for (int j = 0; j < columns; ++j) {
        line += table_.cells[i * columns + j].openPairs != 0 ? 1 : 0;
        table_.open[(i + 1) * (columns + 1) + j + 1] =
            table_.open[i * (columns + 1) + j + 1] + line;
      }
    }
  }

  const CheckerModel& model_;
  const LaneModel& lanes_;
  const LaneBodyPair& bodies_;
  JointTable table_;
  std::vector<int> pathA_, pathB_, path_;
  std::array<double, 2> low_{};
  std::array<double, 2> step_{1.0, 1.0};
  std::uint8_t bit_ = 0;  ///< of the pair
  bool touching_ = false;
  bool compared_ = false;  ///< exactly
  double slack_ = 0.0;     ///< m
  int geometryA_ = 0;
  int geometryB_ = 0;
  Balls stopped_{-1, -1};
  double meeting_ = 0.0;  ///< m, the most that balls inside overlap in the middle of the cells
  Balls meetingBalls_{-1, -1};
  int work_ = 0;
};

}  // namespace

bool JointTable::find(const Values& lower, const Values& upper, Range& range) const {
  for (int k = 0; k < joints; ++k) {
    const Axis& axis = axes[k];
    if (!(lower[k] >= axis.lower && upper[k] <= axis.upper)) return false;
    const auto cellOf = [&axis](float value) {
      return std::min(static_cast<int>((value - axis.lower) * axis.cellsPerUnit), axis.cells - 1);
    };
    range.begin[k] = cellOf(lower[k]);
    range.end[k] = cellOf(upper[k]) + 1;
  }
  return true;
}

const JointTable::Cell* JointTable::cellAt(const Values& values) const {
  Range range;
  if (!find(values, values, range)) return nullptr;
  return &cells[static_cast<std::size_t>(range.begin[0] * axes[1].cells + range.begin[1])];
}

bool JointTable::free(const Values& lower, const Values& upper) const {
  Range range;
  if (!find(lower, upper, range)) return false;
  const int width = axes[1].cells + 1;
  const auto at = [&](int i, int j) { return open[static_cast<std::size_t>(i * width + j)]; };
  return at(range.end[0], range.end[1]) + at(range.begin[0], range.begin[1]) ==
         at(range.end[0], range.begin[1]) + at(range.begin[0], range.end[1]);
}

std::uint8_t JointTable::openPairs(const Values& lower, const Values& upper) const {
  constexpr int kMostCells = 256;
  constexpr std::uint8_t kAll = 0xFF;
  Range range;
  if (!find(lower, upper, range)) return kAll;
  const int count = (range.end[0] - range.begin[0]) * (range.end[1] - range.begin[1]);
  if (count > kMostCells) return kAll;
  std::uint8_t found = 0;
  for (int i = range.begin[0]; i < range.end[0]; ++i)
    for (int j = range.begin[1]; j < range.end[1]; ++j)
      found |= cells[static_cast<std::size_t>(i * axes[1].cells + j)].openPairs;
  return found;
}

std::shared_ptr<const JointTable> buildJointTable(const CheckerModel& model, const LaneModel& lanes,
                                                  const LaneBodyPair& bodies, int& budget) {
  return TableBuilder(model, lanes, bodies).build(budget);
}

}  // namespace swept::detail
