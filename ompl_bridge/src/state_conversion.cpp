// SPDX-License-Identifier: BSD-3-Clause
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/base/spaces/SE3StateSpace.h>
#include <ompl/base/spaces/SO2StateSpace.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "state_layout.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/ompl_bridge/state_space.hpp"
#include "swept/robot_model/limits.hpp"

namespace swept {
namespace ob = ompl::base;
using detail::SubspaceKind;
namespace {

// Into [-pi, pi): OMPL has pi outside the bounds of SO(2).
double wrapped(double angle) {
  const double rest = std::remainder(angle, 2.0 * std::numbers::pi);
  return rest >= std::numbers::pi ? -std::numbers::pi : rest;
}

void setRotation(std::span<const double> q, ob::SO3StateSpace::StateType& rotation) {
  const double norm = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
  const double length = norm > 0.0 && std::isfinite(norm) ? norm : 1.0;
  rotation.x = q[0] / length;
  rotation.y = q[1] / length;
  rotation.z = q[2] / length;
  rotation.w = q[3] / length;
}

void requireSize(std::size_t given, int dimension) {
  if (given == static_cast<std::size_t>(dimension)) return;
  throw std::invalid_argument("a configuration of the group has " + std::to_string(dimension) +
                              " values, not " + std::to_string(given));
}

}  // namespace

StateConversion::StateConversion(const Robot& robot, const Group& group) {
  const std::vector<detail::JointRun> runs = detail::jointRuns(robot, group);
  compound_ = !detail::isSingleRealVector(runs);
  for (const detail::JointRun& run : runs) {
    const int size = static_cast<int>(run.variables.size());
    blocks_.push_back({run.kind, dimension_, size});
    dimension_ += size;
    for (const int v : run.variables) variables_.push_back(robot.variables()[v]);
  }
}

void StateConversion::toConfiguration(const ob::State* state, ConfigurationSpan q) const {
  requireSize(q.size(), dimension_);
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    const ob::State* part = compound_ ? state->as<ob::CompoundState>()->components[i] : state;
    const std::span<double> out = q.subspan(blocks_[i].first, blocks_[i].size);
    switch (blocks_[i].kind) {
      case SubspaceKind::RealVector:
        std::copy_n(part->as<ob::RealVectorStateSpace::StateType>()->values, out.size(),
                    out.data());
        break;
      case SubspaceKind::SO2:
        out[0] = part->as<ob::SO2StateSpace::StateType>()->value;
        break;
      case SubspaceKind::SE2: {
        const auto* pose = part->as<ob::SE2StateSpace::StateType>();
        out[0] = pose->getX();
        out[1] = pose->getY();
        out[2] = pose->getYaw();
        break;
      }
      case SubspaceKind::SE3: {
        const auto* pose = part->as<ob::SE3StateSpace::StateType>();
        const ob::SO3StateSpace::StateType& rotation = pose->rotation();
        out[0] = pose->getX();
        out[1] = pose->getY();
        out[2] = pose->getZ();
        out[3] = rotation.x;
        out[4] = rotation.y;
        out[5] = rotation.z;
        out[6] = rotation.w;
        break;
      }
    }
  }
}

void StateConversion::toState(ConfigurationView q, ob::State* state) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, q, state] { return toState(q, state); });
  }
  requireSize(q.size(), dimension_);
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    ob::State* part = compound_ ? state->as<ob::CompoundState>()->components[i] : state;
    const std::span<const double> in = q.subspan(blocks_[i].first, blocks_[i].size);
    switch (blocks_[i].kind) {
      case SubspaceKind::RealVector:
        for (std::size_t k = 0; k < in.size(); ++k) {
          const Variable& variable = variables_[static_cast<std::size_t>(blocks_[i].first) + k];
          part->as<ob::RealVectorStateSpace::StateType>()->values[k] =
              limitNear(variable, in[k]).value_or(in[k]);
        }
        break;
      case SubspaceKind::SO2:
        part->as<ob::SO2StateSpace::StateType>()->value = wrapped(in[0]);
        break;
      case SubspaceKind::SE2: {
        auto* pose = part->as<ob::SE2StateSpace::StateType>();
        pose->setXY(in[0], in[1]);
        pose->setYaw(wrapped(in[2]));
        break;
      }
      case SubspaceKind::SE3: {
        auto* pose = part->as<ob::SE3StateSpace::StateType>();
        pose->setXYZ(in[0], in[1], in[2]);
        setRotation(in.subspan(3), pose->rotation());
        break;
      }
    }
  }
}

}  // namespace swept
