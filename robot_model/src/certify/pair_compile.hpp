// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace swept::detail {

struct CheckerModel;
struct GeometryPair;

/// Which pairs of the model's geometry are checked, with their margins, and the lists of pairs of
/// bodies. Throws std::invalid_argument for a rule about a body that is not there.
void compilePairs(CheckerModel& model);

/// A pair with this piece of the world of the geometry that `like` is a pair of, or one of
/// CheckerModel::likeWorldPairs.
GeometryPair worldPair(const CheckerModel& model, const GeometryPair& like, int worldGeometry);

}  // namespace swept::detail
