// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "output/text_output.hpp"
#include "page/page_content.hpp"
#include "page/page_curves.hpp"

namespace swept {

/// The `curve` of a page's motion: the polynomials, bit for bit, and what is known about it. Times
/// in s; values in rad, m, and their rates; null: no limit.
Json curveJson(const Checker& checker, const PageContent::Trajectory& trajectory,
               const CurvePieces& pieces);

}  // namespace swept
