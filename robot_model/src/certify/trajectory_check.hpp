// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "certify/checker_model.hpp"
#include "certify/workspace_data.hpp"
#include "swept/robot_model/piecewise_polynomial.hpp"
#include "swept/robot_model/trajectory_certificate.hpp"

namespace swept::detail {

/// Proves a curve run by run: see runFrom(). The curve has a value for each of the group's
/// variables.
TrajectoryCertificate certifyTrajectory(const CheckerModel& model, const PiecewisePolynomial& curve,
                                        const TrajectoryQuery& query, WorkspaceData& workspace);

/// The name of a floating joint whose orientation changes along a piece that is no straight motion:
/// its components are no polynomials then. Empty: there is none.
std::string turnsFreely(const CheckerModel& model, const PiecewisePolynomial& curve);

}  // namespace swept::detail
