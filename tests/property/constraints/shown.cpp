// SPDX-License-Identifier: BSD-3-Clause
#include "shown.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "certificate/constraints_json.hpp"
#include "certificate/model_json.hpp"
#include "swept/robot_model/checker.hpp"
#include "verify/constraint.hpp"

namespace constraints {

namespace {

namespace verify = swept::verify;

std::vector<double> ordered(const Eigen::VectorXd& values, std::span<const int> order) {
  std::vector<double> own;
  for (const int i : order) own.push_back(values[i]);
  return own;
}

Eigen::VectorXd vectorOf(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values));
}

/// The end of a piece: a polynomial of the fifth degree has six such values.
verify::Point pointOf(const swept::PiecewisePolynomial& curve, std::size_t piece, bool atEnd,
                      std::span<const int> order) {
  const Eigen::MatrixXd& b = curve.coefficients(piece);
  const Eigen::Index last = b.cols() - 1;
  const auto degree = static_cast<double>(last);
  const double begin = curve.knots()[piece], end = curve.knots()[piece + 1];
  const double time = end - begin;
  const auto from = [&](Eigen::Index k) -> Eigen::VectorXd {
    return b.col(atEnd ? last - std::min(k, last) : std::min(k, last));
  };
  const double way = atEnd ? -1.0 : 1.0;
  const Eigen::VectorXd velocity = way * degree / time * (from(1) - from(0));
  Eigen::VectorXd acceleration = Eigen::VectorXd::Zero(b.rows());
  if (last >= 2)
    acceleration = degree * (degree - 1.0) / (time * time) * (from(2) - 2.0 * from(1) + from(0));
  return {.time = atEnd ? end : begin,
          .positions = ordered(from(0), order),
          .velocities = ordered(velocity, order),
          .accelerations = ordered(acceleration, order)};
}

std::vector<verify::Motion> motionsOf(const Case& of, const verify::Model& model,
                                      std::span<const int> order) {
  std::vector<verify::Motion> motions;
  if (!of.curve) {
    motions.emplace_back(model, ordered(vectorOf(of.from), order), ordered(vectorOf(of.to), order));
    return motions;
  }
  for (std::size_t piece = 0; piece < of.curve->pieces(); ++piece)
    motions.emplace_back(model, pointOf(*of.curve, piece, false, order),
                         pointOf(*of.curve, piece, true, order));
  return motions;
}

}  // namespace

std::optional<bool> isShown(const Case& of, const swept::Checker& checker,
                            std::span<const int> order) {
  const verify::Model model = verify::readModel(swept::modelJson(checker));
  const auto constraints = verify::readConstraints(swept::constraintsJson(checker), model);
  if (of.curve)
    for (std::size_t piece = 0; piece < of.curve->pieces(); ++piece)
      if (of.curve->degree(piece) > 5) return {};
  for (const verify::Motion& motion : motionsOf(of, model, order))
    for (const verify::Constraint& constraint : constraints) {
      try {
        verify::checkConstraint(model, motion, constraint, constraint.name);
      } catch (const verify::Refusal&) {
        return false;
      }
    }
  return true;
}

}  // namespace constraints
