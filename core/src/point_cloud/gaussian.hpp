// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace swept::detail {

/// P(z <= x) for a standard normal z.
double normalCdf(double x);
double normalDensity(double x);

/// P(|z| > x) for a standard normal z in three dimensions; 1 for x <= 0.
double tailBeyond(double x);

/// A bound on |d^2/dx^2 P(z <= x)| over [middle - reach, middle + reach].
double cdfCurvature(double middle, double reach);

/// P(|m + s z| <= radius) for a standard normal z in three dimensions, |m| = distance and s > 0:
/// a noncentral chi distribution of three degrees of freedom, in closed form.
double ballProbability(double distance, double radius, double s);

}  // namespace swept::detail
