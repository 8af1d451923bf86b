// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "intervals.hpp"
#include "model.hpp"

namespace swept::verify {

/// Names what `model` has, with a digest of each: `joints`, `bodies` and, together, `rules` (all
/// else).
Json digestsOf(const Json& model);
/// Of what a path file has beside its states, its proof and where its model comes from: `claims`.
Json claimDigests(const Json& path);
/// Of the two states of a segment.
std::string stateDigest(const Json& from, const Json& to);
/// Of what proves a pair of bodies apart during a segment, without its own `digest`.
std::string pairDigest(Json pair);

/// That a model is the one that a proof is about. Throws Refusal, which names what is not.
void requireSameModel(const Json& proof, const Json& model);

/// Checks the proof of a path file against a model of its robot and world. Throws Refusal, which
/// names the place, at the first thing that is wrong.
Summary checkProof(const Json& path, const Json& model);

}  // namespace swept::verify
