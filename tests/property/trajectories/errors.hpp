// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "stage.hpp"

namespace trajectories {

/// Which configuration of a tube.
enum class Error : std::uint8_t {
  None,    ///< the middle
  Corner,  ///< every joint as far off as it may be, with random signs
  Plus,    ///< with the same sign
  Inside   ///< anywhere
};
inline constexpr std::array kErrors{Error::None, Error::Corner, Error::Plus, Error::Inside};

/// Displaces a configuration. Values that slide stay within their limits.
void displace(const Stage& stage, Error error, Random& random, std::vector<double>& q);

/// Displaces it to the corner at which a function with this gradient is least, to first order.
void displaceAgainst(const Stage& stage, const std::vector<double>& gradient, Random& random,
                     std::vector<double>& q);

/// How far a configuration is outside of the tube around another one (rad or m); negative: inside.
double beyondTube(const Stage& stage, const std::vector<double>& q,
                  const std::vector<double>& around);

}  // namespace trajectories
