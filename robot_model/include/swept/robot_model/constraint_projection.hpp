// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>

#include "swept/robot_model/configuration.hpp"

namespace swept {

class Checker;

namespace detail {
struct ConstraintTask;
}  // namespace detail

/// How far ConstraintProjection::project goes.
struct ConstraintProjectionOptions {
  /// In (0, 1). Constraints that use more of their tolerance are brought to this share of it, or to
  /// a tenth of the rest more.
  double share = 0.5;
  int maxIterations = 40;  ///< steps tried
};

/// Brings configurations to where the constraints of a checker hold (TaskConstraint). It finds
/// them by numbers and proves nothing: Checker::checkState does. It ignores collisions.
///
/// Each constraint limits quantities: an angle or a length, or the length of a vector of two or
/// three, is at most a tolerance. A joint's value has one, about the middle of what is allowed; a
/// box one for each side, a sphere one, a cylinder two; an orientation one for each of its angles;
/// an axis one. Tolerances without effect (sides that are infinite, angles of pi and more) have
/// none.
///
/// All variables of the group that take part may change. Any number of threads may use one object,
/// each with its own workspace.
class ConstraintProjection {
 public:
  /// Scratch memory for one thread, for the object that it was made for and its copies.
  class Workspace {
   public:
    /// Allocates all that the functions need.
    explicit Workspace(const ConstraintProjection& projection);
    ~Workspace();
    ///@{
    /// A workspace that was moved from can only be assigned to and destroyed.
    Workspace(Workspace&&) noexcept;
    Workspace& operator=(Workspace&&) noexcept;
    ///@}

   private:
    friend class ConstraintProjection;
    struct Data;
    std::unique_ptr<Data> data_;
  };

  /// Reads group, constraints, reference and attached bodies of the checker, and the robot's
  /// limits. Keeps no reference to it.
  explicit ConstraintProjection(const Checker& checker);
  ~ConstraintProjection();
  ///@{
  /// Copies share the compiled constraints.
  ConstraintProjection(const ConstraintProjection&);
  ConstraintProjection(ConstraintProjection&&) noexcept;
  ConstraintProjection& operator=(const ConstraintProjection&);
  ConstraintProjection& operator=(ConstraintProjection&&) noexcept;
  ///@}

  /// The same with tighter limits (rad or m, a value for each variable of the group), as
  /// InverseKinematics::within. Throws std::invalid_argument for spans of the wrong size, and if no
  /// value is left.
  ConstraintProjection within(ConfigurationView lower, ConfigurationView upper) const;

  int dimension() const;  ///< of a configuration of the group
  /// Degrees of freedom: one for each variable, except that the four of a quaternion have three.
  int degreesOfFreedom() const;
  /// The number of values that the constraints limit: of a vector, each component.
  int rows() const;
  /// Whether there is nothing to hold.
  bool empty() const { return rows() == 0; }

  /// The largest share of a tolerance that is used, up to rounding: at most 1 where all constraints
  /// hold. A tolerance below 1e-9 (rad or m) counts as 1e-9. Infinite for a configuration without a
  /// pose: not finite, with a zero quaternion, or beyond the limits of a prismatic joint. Throws
  /// std::invalid_argument for the wrong size or another object's workspace.
  double usedShare(ConfigurationView q, Workspace& workspace) const;

  /// Moves `q` to where every constraint uses no more of its tolerance than options.share, or a
  /// tenth of the rest more; constraints that use less do not pull. Damped Gauss-Newton steps
  /// (Levenberg and Marquardt), which are cut off at the limits (Bertsekas 1982). Values outside
  /// their limits are moved to them first. Returns false if it found no such configuration from
  /// `q`, which proves nothing; `q` is then the best one found. The same arguments give the same
  /// result. Allocates nothing.
  ///
  /// Throws std::invalid_argument for the wrong size, a value that is not finite, a quaternion
  /// without direction, a share that is not in (0, 1), a negative number of iterations and another
  /// object's workspace.
  bool project(ConfigurationSpan q, const ConstraintProjectionOptions& options,
               Workspace& workspace) const;

  /// The values that the constraints limit, each as a share of its tolerance (signed): of regions,
  /// those of the nearest one, and 0 for rows that it does not use. All 0 is the middle of all
  /// constraints. `values` has rows() entries. Throws std::invalid_argument as usedShare() does,
  /// and for a configuration without a pose.
  void residuals(ConfigurationView q, Eigen::Ref<Eigen::VectorXd> values,
                 Workspace& workspace) const;
  /// Their derivatives per unit (rad or m) of each degree of freedom: rows() x degreesOfFreedom().
  /// Degrees are as in InverseKinematics::jacobian. Throws likewise.
  void jacobian(ConfigurationView q, Eigen::Ref<Eigen::MatrixXd> derivatives,
                Workspace& workspace) const;

 private:
  class Evaluation;
  class Search;
  explicit ConstraintProjection(std::shared_ptr<const detail::ConstraintTask> task);
  void requireFit(std::size_t size, const Workspace& workspace) const;
  std::shared_ptr<const detail::ConstraintTask> task_;
};

}  // namespace swept
