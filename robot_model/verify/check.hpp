// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "intervals.hpp"
#include "model.hpp"

namespace swept::verify {

/// Called between two pairs of bodies; what it throws ends the check. Empty: nothing is called.
using Pause = std::function<void()>;

/// Names of the parts of `model`, with a digest of each: `joints`, `bodies` and, together, `rules`
/// (everything else).
Json digestsOf(const Json& model);
/// Digest of the content of a path file besides its states, its trajectory, its proof and the
/// source of its model: `claims`.
Json claimDigests(const Json& path);
/// Digest of the two states of a segment, or the two points of a trajectory.
std::string stateDigest(const Json& from, const Json& to);
/// Digest of the proof that a pair of bodies stays apart during a segment, without its own
/// `digest`.
std::string pairDigest(Json pair);

/// Checks that a proof is about this model. Throws Refusal, which names the difference.
void requireSameModel(const Json& proof, const Json& model);

/// Checks the proof of a path file against a model of its robot and world. Throws Refusal, which
/// names the place, at the first error.
Summary checkProof(const Json& path, const Json& model, const Pause& pause = {});

}  // namespace swept::verify
