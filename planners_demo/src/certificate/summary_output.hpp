// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "certificate/verify_outcome.hpp"
#include "input/task.hpp"
#include "output/text_output.hpp"

/// What is said of a proof that was verified.
namespace swept {

/// `every pair keeps more than 0.01 m; pairs with the world more than ...`.
std::string keptText(const verify::Summary& summary);
/// `tube 0.005 rad, `; empty, or of a trajectory `no tube, `: there is none.
std::string tubeText(const verify::Summary& summary);
/// As `--json` prints it.
Json outcomeJson(const VerifyOutcome& outcome);
/// What a path says that it is not about, where no files say it again.
void repeatWarnings(const Json& path, Warnings& warnings);

}  // namespace swept
