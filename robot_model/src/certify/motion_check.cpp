// SPDX-License-Identifier: BSD-3-Clause
#include "certify/motion_check.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <utility>
#include <vector>

#include "certify/exact_tier.hpp"
#include "certify/nearest_points.hpp"
#include "certify/pair_oracle.hpp"
#include "certify/waypoint_segments.hpp"
#include "certify/work_limits.hpp"
#include "constraints/constraint_proof.hpp"
#include "simd/kernels/constraint_lanes.hpp"
#include "simd/kernels/simd_motion.hpp"
#include "simd/search/simd_search.hpp"

namespace swept::detail {

namespace {

/// The certificate of what is open in the workspace's ProofWork, of one part. Both queries take the
/// same steps until the first contact; see ConfirmedContacts. `motion`: in single precision, of the
/// path. `spent`: effort of earlier parts, which counts against the limits.
MotionCertificate proveOpen(const CheckerModel& model, const JointPath& path, SimdMotion& motion,
                            MotionQuery wanted, const Effort& spent, WorkspaceData& workspace) {
  MotionCertificate certificate;
  Effort& effort = certificate.effort;
  effort = spent;
  ConfirmedContacts contacts(wanted);
  PairQuery query(model, workspace);
  PairOracle oracle(model, path, query, contacts, effort);
  SimdTier simd(motion, oracle, contacts, subIntervalsLeft(model, effort), workspace.simd, effort);
  ExactTier exact(model, query, oracle, contacts, workspace, effort);

  ProofWork& work = workspace.work;
  for (ProofTier* tier : std::initializer_list<ProofTier*>{&simd, &exact}) {
    tier->prove(work);
    if (work.isProven() || contacts.settle()) break;
  }

  certificate.freeUntil = work.provenUntil;
  if (contacts.any()) {
    certificate.verdict = Verdict::Collision;
    certificate.witness = contacts.earliest();
    if (wanted == MotionQuery::FirstContact && oracle.start()) {
      takeNearestPoints(model, query, workspace, *certificate.witness);
    }
  } else if (work.isProven()) {
    certificate.verdict = Verdict::Free;
  } else {
    certificate.undecidedAt = work.provenUntil;
  }
  if (wanted == MotionQuery::VerdictOnly && certificate.verdict != Verdict::Free)
    certificate.freeUntil = 0.0;
  return certificate;
}

/// All pairs, on all of the part.
MotionCertificate provePart(const CheckerModel& model, const JointPath& path, SimdMotion& motion,
                            MotionQuery wanted, const Effort& spent, WorkspaceData& workspace) {
  workspace.work.begin();
  return proveOpen(model, path, motion, wanted, spent, workspace);
}

/// Adds a part's certificate to that of the parts before it. Its effort includes theirs.
void addPart(const WaypointSegment& part, MotionCertificate&& own, MotionCertificate& all) {
  all.effort = own.effort;
  const bool open = all.verdict != Verdict::Free;  // an earlier part was left undecided
  if (!open) all.freeUntil = part.timeOf(own.freeUntil);
  if (own.verdict == Verdict::Free) return;
  if (own.verdict == Verdict::Collision) {
    all.verdict = own.verdict;
    all.witness = std::move(own.witness);
    if (all.witness) all.witness->t = part.timeOf(all.witness->t);
  } else if (!open) {
    all.verdict = own.verdict;
    all.undecidedAt = part.timeOf(own.undecidedAt);
  }
}

SimdMotion motionOf(const CheckerModel& model, const JointPath& path, WorkspaceData& workspace) {
  return {model.simd, model.kinematics, path, workspace.motion, workspace.simd};
}

/// `motion`: in single precision, of the path.
MotionCertificate certifyPairs(const CheckerModel& model, const JointPath& path, SimdMotion& motion,
                               MotionQuery wanted, WorkspaceData& workspace) {
  if (model.world->obstacles().empty())
    return provePart(model, path, motion, wanted, {}, workspace);
  MotionCertificate certificate;
  certificate.verdict = Verdict::Free;
  WaypointSegments(model, path, workspace).forEach([&](const WaypointSegment& part) {
    SimdMotion own = motionOf(model, part.path, workspace);
    addPart(part, provePart(model, part.path, own, wanted, certificate.effort, workspace),
            certificate);
    const bool settled = certificate.verdict == Verdict::Free;
    if (!settled && !workLeft(model, certificate.effort)) return false;
    return certificate.verdict != Verdict::Collision;
  });
  if (wanted == MotionQuery::VerdictOnly && certificate.verdict != Verdict::Free)
    certificate.freeUntil = 0.0;
  return certificate;
}

/// Constraints in the eighths of a motion first, where the pairs need them anyway; then exactly,
/// where they are not known to hold.
ConstraintProof certifyConstraints(const CheckerModel& model, const JointPath& path,
                                   SimdMotion& motion, MotionQuery wanted,
                                   WorkspaceData& workspace) {
  ConstraintQuestion question = constraintsOf(model, workspace);
  std::vector<std::uint8_t>& kept = workspace.constraints.kept;
  const std::size_t count = model.laneConstraints.constraints.size();
  if (count == 0 || model.options.maxIntervals < kLanes || !motion.compile())
    return proveConstraints(question, path, wanted);
  motion.placeEighths();
  motion.setMoving();
  kept.resize(count);
  findKeptLanes(model.laneConstraints, model.simd, motion.extent(), workspace.simd, kept);
  if (std::ranges::all_of(kept, [](std::uint8_t lanes) { return lanes == kAllLanes; }))
    return {.intervals = kLanes};
  question.kept = kept;
  ConstraintProof proof = proveConstraints(question, path, wanted);
  proof.intervals += kLanes;
  return proof;
}

/// Adds what is known about the constraints to what is known about the pairs.
MotionCertificate together(const ConstraintProof& task, MotionQuery wanted,
                           MotionCertificate&& pairs) {
  MotionCertificate certificate = std::move(pairs);
  certificate.effort.constrained = task.intervals;
  if (task.verdict == Verdict::Free) return certificate;
  if (wanted == MotionQuery::VerdictOnly)
    certificate.freeUntil = 0.0;
  else
    certificate.freeUntil = std::min(certificate.freeUntil, task.holdsUntil);
  if (task.verdict == Verdict::Violation) {
    certificate.verdict = Verdict::Violation;
    certificate.violation = task.violation;
    certificate.witness.reset();
    certificate.undecidedAt = 0.0;
  } else if (certificate.verdict != Verdict::Collision) {
    certificate.undecidedAt = certificate.verdict == Verdict::Free
                                  ? task.undecidedAt
                                  : std::min(certificate.undecidedAt, task.undecidedAt);
    certificate.verdict = Verdict::Undecided;
  }
  return certificate;
}

}  // namespace

MotionCertificate certifyMotion(const CheckerModel& model, const JointPath& path,
                                MotionQuery wanted, WorkspaceData& workspace) {
  SimdMotion motion = motionOf(model, path, workspace);
  if (model.constraints.empty()) return certifyPairs(model, path, motion, wanted, workspace);
  // First, for they take less time than pairs do.
  const ConstraintProof task = certifyConstraints(model, path, motion, wanted, workspace);
  if (task.verdict == Verdict::Violation && wanted == MotionQuery::VerdictOnly)
    return together(task, wanted, {});
  return together(task, wanted, certifyPairs(model, path, motion, wanted, workspace));
}

Verdict certifyOpen(const CheckerModel& model, std::span<const double> from,
                    std::span<const double> to, WorkspaceData& workspace) {
  workspace.work.everything = false;
  workspace.work.provenUntil = 0.0;
  const StraightPath path(model.kinematics, from, to);
  SimdMotion motion = motionOf(model, path, workspace);
  return proveOpen(model, path, motion, MotionQuery::VerdictOnly, {}, workspace).verdict;
}

MotionCertificate certifyMotion(const CheckerModel& model, std::span<const double> from,
                                std::span<const double> to, MotionQuery wanted,
                                WorkspaceData& workspace) {
  return certifyMotion(model, StraightPath(model.kinematics, from, to), wanted, workspace);
}

}  // namespace swept::detail
