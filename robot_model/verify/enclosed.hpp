// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "motion.hpp"
#include "proof.hpp"

namespace swept::verify {

/// Planes between triangles do not show that a body is not inside a closed mesh. This is tested
/// once, at the beginning: surfaces that never meet do not change sides. One plane that separates
/// all of both bodies shows it, too. Throws Refusal, which starts with `place`.
void requireNotEnclosed(const Model& model, const Motion& motion, PairToProve pair,
                        const Json& proof, const std::string& place);

}  // namespace swept::verify
