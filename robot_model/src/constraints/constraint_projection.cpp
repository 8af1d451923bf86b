// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/constraint_projection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "constraints/constraint_task.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "text/numbers.hpp"

namespace swept {

namespace {

using detail::AnglesPart;
using detail::ConstraintPart;
using detail::ConstraintRow;
using detail::ConstraintTask;
using detail::FramePair;
using detail::JointPart;
using detail::RegionsPart;
using detail::TiltPart;
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kStraight = std::numbers::pi;

[[noreturn]] void refuseProjection(const std::string& what) {
  throw std::invalid_argument("ConstraintProjection: " + what);
}

/// How the vector of a rotation changes with the rotation that is put before it: the inverse of the
/// left Jacobian of SO(3).
Matrix3d rateOfRotationVector(const Vector3d& v) {
  constexpr double kSmall = 1e-4;  // below, the series is exact to rounding
  const double angle = v.norm();
  const double half = 0.5 * angle;
  const double share =
      angle < kSmall ? 1.0 / 12.0 : (1.0 - half / std::tan(half)) / (angle * angle);
  Matrix3d cross;
  cross << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return Matrix3d::Identity() - 0.5 * cross + share * cross * cross;
}

/// What the three angles of R = Rx(a) Ry(b) Rz(c) are.
Vector3d eulerAngles(const Matrix3d& r) {
  return {std::atan2(-r(1, 2), r(2, 2)), std::atan2(r(0, 2), std::hypot(r(0, 0), r(0, 1))),
          std::atan2(-r(0, 1), r(0, 0))};
}

/// How they change with a rotation that is put before R. Damped where they are not single.
Matrix3d rateOfEulerAngles(const Vector3d& angles) {
  constexpr double kLeastCosine = 1e-3;
  const double sa = std::sin(angles.x()), ca = std::cos(angles.x());
  const double sb = std::sin(angles.y());
  const double cb = std::max(std::cos(angles.y()), kLeastCosine);
  Matrix3d rate;
  rate << 1.0, sa * sb / cb, -ca * sb / cb,  //
      0.0, ca, sa,                           //
      0.0, -sa / cb, ca / cb;
  return rate;
}

}  // namespace

struct ConstraintProjection::Workspace::Data {
  explicit Data(const ConstraintTask& task)
      : candidate(task.freedom.degreeOf.size()),
        world_from_joint(task.kinematics.bodies.size(), Isometry3d::Identity()),
        world_from_body(task.kinematics.bodies.size(), Isometry3d::Identity()),
        rows(static_cast<std::size_t>(task.rows)),
        relative(6, task.freedom.count()),
        gradients(task.rows, task.freedom.count()),
        steepest(task.rows, task.freedom.count()),
        beyond(task.rows),
        pull(task.rows),
        step(task.freedom.count()),
        normal(task.rows, task.rows),
        solver(task.rows) {}

  std::vector<double> candidate;
  std::vector<Isometry3d> world_from_joint, world_from_body;  ///< by body
  std::vector<ConstraintRow> rows;
  detail::PointJacobian relative;
  Eigen::MatrixXd gradients;  ///< of the rows
  Eigen::MatrixXd steepest;   ///< gradients of what is beyond a share of a tolerance
  Eigen::VectorXd beyond, pull, step;
  Eigen::MatrixXd normal;
  Eigen::LDLT<Eigen::MatrixXd> solver;
};

/// Computes rows and their gradients at a configuration.
class ConstraintProjection::Evaluation {
 public:
  Evaluation(const ConstraintTask& task, Workspace& workspace)
      : task_(task), data_(*workspace.data_) {}

  /// False: the configuration has no pose. Gradients are set only if asked for.
  bool at(std::span<const double> q, bool gradients) {
    gradients_ = gradients;
    if (!place(q)) return false;
    if (gradients) data_.gradients.setZero();
    std::ranges::fill(data_.rows, ConstraintRow{});
    for (const ConstraintPart& part : task_.parts) {
      row_ = part.firstRow;
      std::visit([&](const auto& own) { evaluate(own, q); }, part.what);
    }
    return true;
  }

 private:
  bool place(std::span<const double> q) {
    const auto finite = [](double value) { return std::isfinite(value); };
    if (!std::ranges::all_of(q, finite)) return false;
    detail::BodyState parent;
    detail::JointMotion still;
    for (const int i : task_.bodies) {
      const auto index = static_cast<std::size_t>(i);
      const detail::MovingBody& body = task_.kinematics.bodies[index];
      if (!detail::compileJoint(task_.kinematics, body, q, q, still)) return false;
      parent.world_from_body = data_.world_from_body[static_cast<std::size_t>(body.parent)];
      data_.world_from_joint[index] = parent.world_from_body * body.parent_from_joint;
      data_.world_from_body[index] = detail::bodyAt(body, still, 0.0, parent).world_from_body;
    }
    return true;
  }

  const Isometry3d& bodyPose(int body) const {
    return data_.world_from_body[static_cast<std::size_t>(body)];
  }

  /// The velocity of the tool's frame as its reference sees it, in the model frame.
  void differentiate(const FramePair& pair, const Vector3d& point) {
    if (!gradients_) return;
    data_.relative.setZero();
    const auto addPath = [&](const std::vector<int>& path, double sign) {
      for (const int i : path) {
        const auto index = static_cast<std::size_t>(i);
        detail::addJointColumns(
            task_.freedom, task_.kinematics.bodies[index], data_.world_from_joint[index].linear(),
            data_.world_from_body[index].translation(), point, sign, data_.relative);
      }
    };
    addPath(pair.toolPath, 1.0);
    addPath(pair.referencePath, -1.0);
  }

  void put(const ConstraintRow& row) { data_.rows[static_cast<std::size_t>(row_)] = row; }

  /// The gradient of the row from that of the velocity of the point, or of the angular velocity.
  void slope(const Vector3d& direction, bool turns) {
    if (!gradients_) return;
    const auto part = turns ? data_.relative.bottomRows<3>() : data_.relative.topRows<3>();
    data_.gradients.row(row_).noalias() = direction.transpose() * part;
  }

  void evaluate(const JointPart& own, std::span<const double> q) {
    double value = own.offset;
    if (own.variable >= 0) value += own.multiplier * q[static_cast<std::size_t>(own.variable)];
    double away = value - own.position;
    if (own.cyclic) away = std::remainder(away, 2.0 * kStraight);
    put({away - own.middle, own.tolerance, own.slides ? task_.scale : 1.0, 1});
    if (gradients_ && own.degree >= 0) data_.gradients(row_, own.degree) = own.multiplier;
  }

  struct Region {
    std::array<ConstraintRow, 3> rows;
    std::array<bool, 3> limited{};
    double excess = 0.0;  ///< m squared
  };

  /// What a region limits of a point in its frame.
  static Region regionAt(const ConstraintRegion& region, const Vector3d& p, double unit) {
    Region result;
    const auto beyond = [&](double value, double most) {
      const double excess = std::max(0.0, value - most);
      result.excess += excess * excess;
    };
    const Vector3d& size = region.size;
    const auto put = [&](int i, double tolerance, int count) {
      const auto index = static_cast<std::size_t>(i);
      result.limited[index] = std::isfinite(tolerance);
      if (result.limited[index]) result.rows[index] = {p[i], tolerance, unit, count};
    };
    switch (region.type) {
      case ConstraintRegion::Type::Box:
        for (int i = 0; i < 3; ++i) {
          put(i, 0.5 * size[i], 1);
          beyond(std::abs(p[i]), 0.5 * size[i]);
        }
        break;
      case ConstraintRegion::Type::Sphere:
        for (int i = 0; i < 3; ++i) put(i, size.x(), i == 0 ? 3 : 0);
        beyond(p.norm(), size.x());
        break;
      case ConstraintRegion::Type::Cylinder:
        for (int i = 0; i < 2; ++i) put(i, size.x(), i == 0 ? 2 : 0);
        put(2, 0.5 * size.y(), 1);
        beyond(p.head<2>().norm(), size.x());
        beyond(std::abs(p.z()), 0.5 * size.y());
        break;
    }
    return result;
  }

  void evaluate(const RegionsPart& own, std::span<const double>) {
    const Vector3d point = bodyPose(own.frames.tool) * own.frames.tool_from_frame.translation();
    differentiate(own.frames, point);
    const Isometry3d world_from_reference =
        bodyPose(own.frames.reference) * own.frames.reference_from_frame;
    Region nearest;
    nearest.excess = std::numeric_limits<double>::infinity();
    Matrix3d axes = Matrix3d::Identity();
    for (const ConstraintRegion& region : own.regions) {
      const Isometry3d world_from_region = world_from_reference * region.reference_from_region;
      const Vector3d p =
          world_from_region.linear().transpose() * (point - world_from_region.translation());
      const Region found = regionAt(region, p, task_.scale);
      if (!(found.excess < nearest.excess)) continue;
      nearest = found;
      axes = world_from_region.linear();
    }
    for (int i = 0; i < 3; ++i, ++row_) {
      const auto index = static_cast<std::size_t>(i);
      put(nearest.rows[index]);
      if (nearest.limited[index]) slope(axes.col(i), false);
    }
  }

  void evaluate(const AnglesPart& own, std::span<const double>) {
    const Matrix3d tool = bodyPose(own.frames.tool).linear() * own.frames.tool_from_frame.linear();
    Matrix3d axes =
        bodyPose(own.frames.reference).linear() * own.frames.reference_from_frame.linear();
    differentiate(own.frames, Vector3d::Zero());
    Vector3d angles;
    Matrix3d rate;
    if (own.parameterization == OrientationConstraint::Parameterization::RotationVector) {
      angles = detail::rotationVector(axes.transpose() * tool * own.desired.transpose());
      if (gradients_) rate = rateOfRotationVector(angles);
    } else {
      axes = axes * own.desired;
      angles = eulerAngles(axes.transpose() * tool);
      if (gradients_) rate = rateOfEulerAngles(angles);
    }
    for (const int i : own.limited) {
      put({angles[i], own.tolerance[i], 1.0, 1});
      if (gradients_) slope(axes * rate.row(i).transpose(), true);
      ++row_;
    }
  }

  /// The rows are the angle times the direction in which the axis is tilted.
  void evaluate(const TiltPart& own, std::span<const double>) {
    const Matrix3d axes =
        bodyPose(own.frames.reference).linear() * own.frames.reference_from_frame.linear();
    const Vector3d a = axes.transpose() * (bodyPose(own.frames.tool).linear() *
                                           (own.frames.tool_from_frame.linear() * own.axis));
    differentiate(own.frames, Vector3d::Zero());
    const double sine = std::hypot(a.x(), a.y());
    const double angle = std::atan2(sine, a.z());
    constexpr double kTiny = 1e-7;  // below, the angle is its sine to rounding, or no direction
    if (sine < kTiny && a.z() < 0.0) {
      put({kStraight, own.tolerance, 1.0, 2});
      slope(axes.col(1), true);
      ++row_;
      put({0.0, own.tolerance, 1.0, 0});
      ++row_;
      return;
    }
    const double stretch = sine < kTiny ? 1.0 : angle / sine;
    // d stretch / d angle, divided by the sine: the change of the angle is minus a_z' / sine.
    const double growth = sine < kTiny ? 0.0 : (sine - angle * a.z()) / (sine * sine * sine);
    const Vector3d rateX(0.0, a.z(), -a.y()), rateY(-a.z(), 0.0, a.x()), rateZ(a.y(), -a.x(), 0.0);
    put({stretch * a.x(), own.tolerance, 1.0, 2});
    slope(axes * (stretch * rateX - (growth * a.x()) * rateZ), true);
    ++row_;
    put({stretch * a.y(), own.tolerance, 1.0, 0});
    slope(axes * (stretch * rateY - (growth * a.y()) * rateZ), true);
    ++row_;
  }

  const ConstraintTask& task_;
  Workspace::Data& data_;
  bool gradients_ = false;
  int row_ = 0;
};

ConstraintProjection::Workspace::Workspace(const ConstraintProjection& projection)
    : data_(std::make_unique<Data>(*projection.task_)) {}

ConstraintProjection::Workspace::~Workspace() = default;
ConstraintProjection::Workspace::Workspace(Workspace&&) noexcept = default;
ConstraintProjection::Workspace& ConstraintProjection::Workspace::operator=(Workspace&&) noexcept =
    default;

ConstraintProjection::ConstraintProjection(const Checker& checker)
    : task_(inDefaultEnvironment(
          [&] { return std::make_shared<const ConstraintTask>(detail::compileTask(checker)); })) {}

ConstraintProjection::ConstraintProjection(std::shared_ptr<const ConstraintTask> task)
    : task_(std::move(task)) {}

ConstraintProjection::~ConstraintProjection() = default;
ConstraintProjection::ConstraintProjection(const ConstraintProjection&) = default;
ConstraintProjection::ConstraintProjection(ConstraintProjection&&) noexcept = default;
ConstraintProjection& ConstraintProjection::operator=(const ConstraintProjection&) = default;
ConstraintProjection& ConstraintProjection::operator=(ConstraintProjection&&) noexcept = default;

ConstraintProjection ConstraintProjection::within(ConfigurationView lower,
                                                  ConfigurationView upper) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, lower, upper] { return within(lower, upper); });
  }
  for (const std::size_t size : {lower.size(), upper.size()})
    if (size != task_->freedom.degreeOf.size())
      refuseProjection("limits of " + std::to_string(size) + " values instead of " +
                       std::to_string(task_->freedom.degreeOf.size()));
  auto task = std::make_shared<ConstraintTask>(*task_);
  if (const auto variable = task->freedom.limit(lower, upper))
    refuseProjection("the limits leave no value to variable '" +
                     task_->variables[static_cast<std::size_t>(*variable)] + "'");
  return ConstraintProjection(std::move(task));
}

int ConstraintProjection::dimension() const {
  return static_cast<int>(task_->freedom.degreeOf.size());
}

int ConstraintProjection::degreesOfFreedom() const {
  return task_->freedom.count();
}

int ConstraintProjection::rows() const {
  return task_->rows;
}

void ConstraintProjection::requireFit(std::size_t size, const Workspace& workspace) const {
  if (size != task_->freedom.degreeOf.size())
    refuseProjection("the configuration has " + std::to_string(size) + " values instead of " +
                     std::to_string(task_->freedom.degreeOf.size()));
  if (workspace.data_->candidate.size() != task_->freedom.degreeOf.size() ||
      workspace.data_->world_from_body.size() != task_->kinematics.bodies.size() ||
      workspace.data_->rows.size() != static_cast<std::size_t>(rows()) ||
      workspace.data_->step.size() != degreesOfFreedom())
    refuseProjection("the workspace is of another object");
}

namespace {

/// Calls `use(first row, norm of its vector)` for each vector whose length is limited.
template <typename Use>
void forEachLimited(std::span<const ConstraintRow> rows, const Use& use) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].count == 0) continue;
    double squared = rows[i].value * rows[i].value;
    for (std::size_t k = i + 1; k < i + static_cast<std::size_t>(rows[i].count); ++k)
      squared += rows[k].value * rows[k].value;
    use(i, std::sqrt(squared));
  }
}

double toleranceOf(const ConstraintRow& row) {
  return std::max(row.tolerance, detail::kLeastLimit);
}

constexpr const char* kNoPose =
    "a value is not finite, a quaternion has no direction, or a prismatic value is outside its "
    "limits";

}  // namespace

double ConstraintProjection::usedShare(ConfigurationView q, Workspace& workspace) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, q] { return usedShare(q, workspace); });
  }
  requireFit(q.size(), workspace);
  if (!Evaluation(*task_, workspace).at(q, false)) return std::numeric_limits<double>::infinity();
  double most = 0.0;
  forEachLimited(workspace.data_->rows, [&](std::size_t i, double length) {
    most = std::max(most, length / toleranceOf(workspace.data_->rows[i]));
  });
  return most;
}

void ConstraintProjection::residuals(ConfigurationView q, Eigen::Ref<Eigen::VectorXd> values,
                                     Workspace& workspace) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, q] { residuals(q, values, workspace); });
  }
  requireFit(q.size(), workspace);
  if (values.size() != rows())
    refuseProjection("room for " + std::to_string(values.size()) + " values instead of " +
                     std::to_string(rows()));
  if (!Evaluation(*task_, workspace).at(q, false)) refuseProjection(kNoPose);
  for (int i = 0; i < rows(); ++i) {
    const ConstraintRow& row = workspace.data_->rows[static_cast<std::size_t>(i)];
    values[i] = row.value / toleranceOf(row);
  }
}

void ConstraintProjection::jacobian(ConfigurationView q, Eigen::Ref<Eigen::MatrixXd> derivatives,
                                    Workspace& workspace) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, q] { jacobian(q, derivatives, workspace); });
  }
  requireFit(q.size(), workspace);
  if (derivatives.rows() != rows() || derivatives.cols() != degreesOfFreedom())
    refuseProjection("derivatives of another size");
  if (!Evaluation(*task_, workspace).at(q, true)) refuseProjection(kNoPose);
  for (int i = 0; i < rows(); ++i)
    derivatives.row(i) = workspace.data_->gradients.row(i) /
                         toleranceOf(workspace.data_->rows[static_cast<std::size_t>(i)]);
}

/// Descends in the squared sum of what is beyond a share of the tolerances. Its steps are those of
/// InverseKinematics, from fewer rows.
class ConstraintProjection::Search {
 public:
  Search(const ConstraintTask& task, std::span<double> q,
         const ConstraintProjectionOptions& options, Workspace& workspace)
      : task_(task),
        q_(q),
        options_(options),
        data_(*workspace.data_),
        evaluation_(task, workspace) {
    task_.freedom.putInPlace(q_);
  }

  bool run() {
    evaluation_.at(q_, true);
    double cost = measure();
    double damping = kFirstDamping;
    bool moved = true;
    for (int i = 0; i < options_.maxIterations && !arrived_; ++i) {
      if (moved) {
        if (i > 0) {
          evaluation_.at(q_, true);
          measure();
        }
        linearise();
      }
      propose(damping);
      evaluation_.at(data_.candidate, false);
      const double next = measure();
      moved = next < cost;
      if (moved) {
        std::ranges::copy(data_.candidate, q_.begin());
        cost = next;
        damping = std::max(damping * kTrustMore, kLeastDamping);
      } else {
        arrived_ = false;
        damping *= kTrustLess;
        if (damping > kMostDamping) break;
      }
    }
    return arrived_;
  }

 private:
  // As in InverseKinematics.
  static constexpr double kFirstDamping = 1e-4;
  static constexpr double kLeastDamping = 1e-8;
  static constexpr double kMostDamping = 1e8;
  static constexpr double kTrustMore = 0.1;
  static constexpr double kTrustLess = 5.0;

  /// Of the rows in the workspace: half the cost's double, and whether all are near enough.
  double measure() {
    const double enough = options_.share + 0.1 * (1.0 - options_.share);
    double cost = 0.0;
    arrived_ = true;
    forEachLimited(data_.rows, [&](std::size_t i, double length) {
      const ConstraintRow& row = data_.rows[i];
      const double tolerance = toleranceOf(row);
      arrived_ = arrived_ && length <= enough * tolerance;
      const double beyond = std::max(0.0, length - options_.share * tolerance) / row.unit;
      cost += beyond * beyond;
    });
    return cost;
  }

  /// Of what is beyond, over the free degrees: others are 0. The length l of a vector v, beyond a
  /// share s, has the second derivative (l - s) / l across v, which is no less of the cost than
  /// what is along it: to the rows n n^T of gradients come sqrt(1 - s / l) (1 - n n^T), n = v / l.
  /// Without these the search goes to and fro around small regions.
  void linearise() {
    Eigen::MatrixXd& steepest = data_.steepest;
    steepest.setZero();
    data_.beyond.setZero();
    forEachLimited(data_.rows, [&](std::size_t i, double length) {
      const ConstraintRow& row = data_.rows[i];
      const double beyond = length - options_.share * toleranceOf(row);
      if (!(beyond > 0.0)) return;
      const auto part = [&](int k) {
        return data_.rows[i + static_cast<std::size_t>(k)].value / length;
      };
      const double across = std::sqrt(beyond / length);
      const auto at = static_cast<Eigen::Index>(i);
      for (int k = 0; k < row.count; ++k) {
        data_.beyond[at + k] = part(k) * beyond / row.unit;
        for (int other = 0; other < row.count; ++other)
          steepest.row(at + k) +=
              ((1.0 - across) * part(k) * part(other) + (k == other ? across : 0.0)) / row.unit *
              data_.gradients.row(at + other);
      }
    });
    for (std::size_t i = 0; i < task_.freedom.degrees.size(); ++i) {
      const detail::Degree& degree = task_.freedom.degrees[i];
      auto column = steepest.col(static_cast<Eigen::Index>(i));
      if (degree.slides) column *= task_.scale;
      if (degree.turn) continue;
      const double wish = -column.dot(data_.beyond);
      if (degree.isHeld(q_[static_cast<std::size_t>(degree.variable)], wish)) column.setZero();
    }
  }

  void propose(double damping) {
    const Eigen::MatrixXd& steepest = data_.steepest;
    data_.normal.noalias() = steepest.lazyProduct(steepest.transpose());
    data_.normal.diagonal().array() += damping;
    data_.solver.compute(data_.normal);
    data_.pull = data_.solver.solve(data_.beyond);
    data_.step.noalias() = -steepest.transpose().lazyProduct(data_.pull);
    task_.freedom.move(q_, data_.step, task_.scale, data_.candidate);
  }

  const ConstraintTask& task_;
  const std::span<double> q_;
  const ConstraintProjectionOptions& options_;
  Workspace::Data& data_;
  Evaluation evaluation_;
  bool arrived_ = false;
};

bool ConstraintProjection::project(ConfigurationSpan q, const ConstraintProjectionOptions& options,
                                   Workspace& workspace) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, q] { return project(q, options, workspace); });
  }
  requireFit(q.size(), workspace);
  if (!(options.share > 0.0 && options.share < 1.0))
    refuseProjection("the share of the tolerances is " + detail::formatNumber(options.share) +
                     "; it must be between 0 and 1");
  if (options.maxIterations < 0)
    refuseProjection("the number of iterations is " + std::to_string(options.maxIterations) +
                     "; it must be at least 0");
  const auto finite = [](double value) { return std::isfinite(value); };
  if (!std::ranges::all_of(q, finite)) refuseProjection("a value is not finite");
  for (const int first : task_->freedom.quaternions)
    if (!detail::hasDirection(&q[static_cast<std::size_t>(first)]))
      refuseProjection("a quaternion has no direction");
  return Search(*task_, q, options, workspace).run();
}

}  // namespace swept
