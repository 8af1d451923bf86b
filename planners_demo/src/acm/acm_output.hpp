// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "input/task.hpp"
#include "output/text_output.hpp"
#include "swept/robot_model/allowed_collision_matrix.hpp"

/// The findings of `swept acm` on a robot, and how they compare with its SRDF.
namespace swept {

struct AcmResult {
  const Arguments& args;
  const Model& model;
  std::vector<LinkPairReport> pairs;
  double limit;          ///< s, of the time; infinity: none
  double seconds = 0.0;  ///< s, to find the pairs out
};

/// One pair of links on which the SRDF and the reports do not agree.
struct AcmDisagreement {
  enum class Kind {
    Collides,  ///< disabled, though there is a configuration in contact
    Open,      ///< disabled, and not known to be apart
    InVain,    ///< checked, though proven never to collide
    Touching,  ///< checked, though in contact in the default state
  };
  Kind kind;
  LinkPairReport pair;
  std::string reason;  ///< the SRDF's, of a disabled pair
};

/// In the order of the kinds. Empty without an SRDF.
std::vector<AcmDisagreement> compareWithSrdf(const AcmResult& result);

std::string acmText(const AcmResult& result, const std::vector<AcmDisagreement>& differences);
Json acmJson(const AcmResult& result, const std::vector<AcmDisagreement>& differences);

}  // namespace swept
