// SPDX-License-Identifier: BSD-3-Clause
#include "swept/ompl_bridge/constrained_space.hpp"

#include <ompl/base/ConstrainedSpaceInformation.h>
#include <ompl/base/Constraint.h>
#include <ompl/base/spaces/constraint/AtlasStateSpace.h>
#include <ompl/base/spaces/constraint/ConstrainedStateSpace.h>
#include <ompl/base/spaces/constraint/ProjectedStateSpace.h>

#include <stdexcept>
#include <string>
#include <tuple>

#include "constraint_values.hpp"
#include "number_text.hpp"
#include "preconditions.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/ompl_bridge/state_space.hpp"
#include "workspace_pool.hpp"

namespace swept {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using ManifoldState = ob::ConstrainedStateSpace::StateType;

[[noreturn]] void refuseSpace(const std::string& what) {
  throw std::invalid_argument("constrained space: " + what);
}

/// Of joints with limits of their own: states of such are a vector.
void requireVector(const Checker& checker) {
  const Robot& robot = checker.robot();
  for (const int index : checker.group().joints) {
    const Joint& joint = robot.joints()[static_cast<std::size_t>(index)];
    if (joint.type != JointType::Revolute && joint.type != JointType::Prismatic)
      refuseSpace("joint '" + joint.name + "' is neither revolute nor prismatic");
  }
}

unsigned coDimension(const Checker& checker) {
  requireVector(checker);
  const int rows = detail::ConstraintValues(checker).rows();
  if (rows == 0) refuseSpace("the checker has no constraint");
  if (rows >= checker.dimension())
    refuseSpace("the constraints limit " + std::to_string(rows) + " values, and the group has " +
                std::to_string(checker.dimension()) + " variables: nothing is left to move");
  return static_cast<unsigned>(rows);
}

double requireShare(double share) {
  if (!(share > 0.0 && share < 1.0))
    refuseSpace("the share of tolerances is " + detail::numberText(share) +
                ", allowed are numbers between 0 and 1");
  return share;
}

/// See makeManifoldConstraint().
class ManifoldConstraint : public ob::Constraint {
 public:
  ManifoldConstraint(const Checker& checker, double share)
      : Constraint(static_cast<unsigned>(checker.dimension()), coDimension(checker),
                   requireShare(share)),
        values_(std::make_unique<detail::ConstraintValues>(checker)) {}

  void function(const Eigen::Ref<const Eigen::VectorXd>& x,
                Eigen::Ref<Eigen::VectorXd> out) const override {
    values_->residuals(x, out);
  }
  void jacobian(const Eigen::Ref<const Eigen::VectorXd>& x,
                Eigen::Ref<Eigen::MatrixXd> out) const override {
    values_->jacobian(x, out);
  }

 private:
  std::unique_ptr<detail::ConstraintValues> values_;
};

const ob::ConstrainedStateSpace& constrainedSpaceOf(const ob::SpaceInformation& si) {
  const auto* space = dynamic_cast<const ob::ConstrainedStateSpace*>(si.getStateSpace().get());
  if (space == nullptr)
    refuseSpace("'" + si.getStateSpace()->getName() + "' is none of OMPL's constrained spaces");
  return *space;
}

std::shared_ptr<const Checker> requireConstrained(std::shared_ptr<const Checker> checker,
                                                  const ob::SpaceInformation& si) {
  checker = detail::requireChecker(std::move(checker), *constrainedSpaceOf(si).getSpace());
  requireVector(*checker);
  return checker;
}

ConfigurationView valuesOf(const ob::State* state) {
  const auto& x = *state->as<ManifoldState>();
  return {x.data(), static_cast<std::size_t>(x.size())};
}

std::shared_ptr<ob::ConstrainedStateSpace> spaceOf(ConstrainedSpace kind,
                                                   const ob::StateSpacePtr& ambient,
                                                   const ob::ConstraintPtr& constraint) {
  if (kind == ConstrainedSpace::Atlas)
    return std::make_shared<ob::AtlasStateSpace>(ambient, constraint);
  return std::make_shared<ob::ProjectedStateSpace>(ambient, constraint);
}

}  // namespace

std::shared_ptr<ob::Constraint> makeManifoldConstraint(const Checker& checker, double share) {
  if (detail::inForeignEnvironment())
    return inDefaultEnvironment([&] { return makeManifoldConstraint(checker, share); });
  return std::make_shared<ManifoldConstraint>(checker, share);
}

ConstrainedValidityChecker::ConstrainedValidityChecker(const ob::SpaceInformationPtr& si,
                                                       std::shared_ptr<const Checker> checker)
    : StateValidityChecker(si),
      checker_(requireConstrained(std::move(checker), *si)),
      pool_(std::make_unique<WorkspacePool>(*checker_)) {}

ConstrainedValidityChecker::~ConstrainedValidityChecker() = default;

bool ConstrainedValidityChecker::isValid(const ob::State* state) const {
  if (detail::inForeignEnvironment())
    return inDefaultEnvironment([&] { return ConstrainedValidityChecker::isValid(state); });
  if (!si_->satisfiesBounds(state)) return false;
  const WorkspacePool::Lease scratch = pool_->lease();
  return checker_->checkState(valuesOf(state), scratch->workspace) == Verdict::Free;
}

og::SimpleSetupPtr makeConstrainedSetup(std::shared_ptr<const Checker> checker,
                                        ConstrainedSpace space, double share) {
  if (detail::inForeignEnvironment())
    return inDefaultEnvironment(
        [&] { return makeConstrainedSetup(std::move(checker), space, share); });
  if (!checker) refuseSpace("no checker given");
  const auto constraint = makeManifoldConstraint(*checker, share);
  const auto ambient = makeStateSpace(checker->robot(), checker->group());
  const auto manifold = spaceOf(space, ambient, constraint);
  const auto si = std::make_shared<ob::ConstrainedSpaceInformation>(manifold);
  si->setStateValidityChecker(std::make_shared<ConstrainedValidityChecker>(si, checker));
  si->setMotionValidator(std::make_shared<CertifiedGeodesicValidator>(si, checker));
  return std::make_shared<og::SimpleSetup>(si);
}

void setConstrainedStartAndGoal(og::SimpleSetup& setup, ConfigurationView start,
                                ConfigurationView goal) {
  if (detail::inForeignEnvironment())
    return inDefaultEnvironment(
        [&, start, goal] { setConstrainedStartAndGoal(setup, start, goal); });
  const ob::SpaceInformationPtr& si = setup.getSpaceInformation();
  const ob::ConstrainedStateSpace& space = constrainedSpaceOf(*si);
  const std::size_t expected = space.getConstraint()->getAmbientDimension();
  ob::ScopedState<> first(si), last(si);
  for (const auto& [name, q, state] :
       {std::tuple{"start", start, &first}, std::tuple{"goal", goal, &last}}) {
    const std::string which = name;
    if (q.size() != expected)
      refuseSpace("the " + which + " has " + std::to_string(q.size()) + " values; there are " +
                  std::to_string(expected) + " variables");
    const Eigen::VectorXd x =
        Eigen::Map<const Eigen::VectorXd>(q.data(), static_cast<Eigen::Index>(q.size()));
    const double used = space.getConstraint()->distance(x);
    if (!space.getConstraint()->isSatisfied(x))
      refuseSpace("the " + which + " uses " + detail::numberText(used) +
                  " of the constraints' tolerances, and the space has states that use " +
                  detail::numberText(space.getConstraint()->getTolerance()) + " or less");
    state->get()->as<ManifoldState>()->copy(x);
  }
  setup.setStartAndGoalStates(first, last);
  setup.setup();
  if (auto* atlas = dynamic_cast<ob::AtlasStateSpace*>(si->getStateSpace().get()))
    for (const ob::State* state : {first.get(), last.get()}) atlas->anchorChart(state);
}

std::vector<std::vector<double>> provenWayPoints(const og::PathGeometric& path) {
  const auto* validator = dynamic_cast<const CertifiedGeodesicValidator*>(
      path.getSpaceInformation()->getMotionValidator().get());
  if (validator == nullptr)
    refuseSpace("the motions of the path are not those of a CertifiedGeodesicValidator");
  std::vector<std::vector<double>> all;
  for (unsigned i = 0; i + 1 < path.getStateCount(); ++i) {
    const std::vector<std::vector<double>> own =
        validator->wayPoints(valuesOf(path.getState(i)), valuesOf(path.getState(i + 1)));
    if (own.empty()) return {};
    all.insert(all.end(), own.begin() + (all.empty() ? 0 : 1), own.end());
  }
  return all;
}

}  // namespace swept
