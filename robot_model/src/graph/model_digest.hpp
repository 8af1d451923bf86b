// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "io/content_hash.hpp"
#include "swept/robot_model/checker.hpp"

/// Hashes of all that an answer of a Checker depends on, in three parts: what differs in one of
/// them is another robot, another question, or another body.
namespace swept::detail {

/// Of links, joints, limits and pairs that the SRDF disables or enables. Names count.
ContentHash::Digest robotDigest(const Robot& robot);
/// Of the group and CheckerOptions, without the rules that name a body of the world.
ContentHash::Digest questionDigest(const Checker& checker);
/// Of a body of the checker's world, with the rules that name it and their places among the others.
ContentHash::Digest bodyDigest(const Checker& checker, const WorldBody& body);

/// Whether a body of one checker's world is the same in the other's, with the same rules. Compares
/// no content of meshes, hulls and clouds: copies of one are the same.
bool isSameBody(const Checker& a, const WorldBody& ofA, const Checker& b, const WorldBody& ofB);

}  // namespace swept::detail
