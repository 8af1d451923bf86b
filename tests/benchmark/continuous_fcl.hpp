// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "continuous_sweeps.hpp"

#ifdef SWEPT_HAS_FCL
/// FCL's continuous and discrete collision on the same motions.
namespace swept::benchmark {

inline fcl::MotionBasePtr<double> fclMotion(PathKind kind, const Eigen::Isometry3d& start,
                                            const Eigen::Isometry3d& goal) {
  switch (kind) {
    case PathKind::Translation:
      return std::make_shared<fcl::TranslationMotiond>(start, goal);
    case PathKind::Linear:
      // The only constructor of FCL 0.7 that sets both the reference point and the velocities.
      return std::make_shared<fcl::InterpMotion<double>>(start.linear(), start.translation(),
                                                         goal.linear(), goal.translation(),
                                                         Eigen::Vector3d(0.0, 0.0, 0.0));
    case PathKind::Screw:
      return std::make_shared<fcl::ScrewMotion<double>>(start, goal);
  }
  return nullptr;
}

/// Gives the sweep FCL's motions. Returns how far the two libraries' poses are apart at most (m,
/// for points within `reach` of the moving frame's origin): their paths are to be the same.
inline double addFclMotions(Sweep& sweep, double reach) {
  sweep.fclMotion = fclMotion(sweep.kind, sweep.motion->at(0.0), sweep.motion->at(1.0));
  const Eigen::Isometry3d stands = sweep.still->at(0.0);
  sweep.fclStill = fclMotion(PathKind::Translation, stands, stands);
  double apart = 0.0;
  for (int i = 0; i <= 8; ++i) {
    const double t = i / 8.0;
    fcl::Transform3d theirs;
    sweep.fclMotion->integrate(t);
    sweep.fclMotion->getCurrentTransform(theirs);
    const Eigen::Isometry3d ours = sweep.motion->at(t);
    apart = std::max(apart, (theirs.translation() - ours.translation()).norm() +
                                reach * (theirs.linear() - ours.linear()).norm());
  }
  return apart;
}

/// `first` moves; meshes come first, as FCL wants them.
struct FclBodies {
  std::shared_ptr<fcl::CollisionGeometryd> moving, still;

  Answer continuous(const Sweep& sweep, fcl::CCDSolverType solver, std::size_t samples) const {
    const fcl::ContinuousCollisionRequestd request(samples, 0.5 / static_cast<double>(samples),
                                                   fcl::CCDM_TRANS, fcl::GST_LIBCCD, solver);
    fcl::ContinuousCollisionResultd result;
    fcl::continuousCollide(moving.get(), sweep.fclMotion.get(), still.get(), sweep.fclStill.get(),
                           request, result);
    return {true, result.is_collide, 0.0, result.time_of_contact};
  }
  Answer samples(const Sweep& sweep, std::size_t count) const {
    return continuous(sweep, fcl::CCDC_NAIVE, count);
  }
  Answer conservativeAdvancement(const Sweep& sweep) const {
    return continuous(sweep, fcl::CCDC_CONSERVATIVE_ADVANCEMENT, 1000);
  }
  bool touches(const Eigen::Isometry3d& still_from_moving) const {
    const fcl::CollisionRequestd request(1, false);
    fcl::CollisionResultd result;
    return fcl::collide(moving.get(), still_from_moving, still.get(), fcl::Transform3d::Identity(),
                        request, result) > 0;
  }
  /// m; 0 where they touch.
  double distance(const Eigen::Isometry3d& still_from_moving) const {
    const fcl::DistanceRequestd request(true);
    fcl::DistanceResultd result;
    fcl::distance(moving.get(), still_from_moving, still.get(), fcl::Transform3d::Identity(),
                  request, result);
    return std::max(0.0, result.min_distance);
  }
  /// At the sweep's instants, whose poses were made before: all of them, or up to the first hit.
  Answer discrete(const Sweep& sweep, bool all) const {
    Answer answer;
    const double last = static_cast<double>(sweep.instants.size() - 1);
    for (std::size_t i = 0; i < sweep.instants.size(); ++i) {
      if (!touches(sweep.instants[i])) continue;
      if (!answer.hit) answer.toc = static_cast<double>(i) / last;
      answer.hit = true;
      if (!all) break;
    }
    return answer;
  }
};

}  // namespace swept::benchmark
#endif
