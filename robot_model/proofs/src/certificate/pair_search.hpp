// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stop_token>

#include "certificate/body_search.hpp"
#include "output/text_output.hpp"
#include "verify/motion.hpp"
#include "verify/proof.hpp"

namespace swept {

/// Looks for intervals and planes that prove two bodies apart during a motion, in the form that
/// checkPair() of robot_model/verify takes. The library's distances say where to put a plane. The
/// verifier's own bound says whether and for how long it separates the bodies.
class PairSearch {
 public:
  /// `keep`: m; what the planes have to show, more than the margin of the pair. Once `stop` is
  /// requested, run() throws SearchStopped.
  PairSearch(const verify::Model& model, const verify::Motion& motion, verify::PairToProve pair,
             SearchedBody& a, SearchedBody& b, double keep, const std::stop_token& stop)
      : model_(model), motion_(motion), pair_(pair), a_(a), b_(b), keep_(keep), stop_(stop) {}

  /// The pair's entry without its digest. Null where no proof was found: the bodies come nearer
  /// than `keep`, or so near that the proof would need too many intervals.
  Json run();

 private:
  struct Between;
  double distanceOf(Between& between) const;
  const verify::PairMotion& stillOf(Between& between) const;
  bool intervals(double begin, double end, int depth, Json& list, bool flat, std::size_t index);
  Json tree(Between& between, int a, int b);
  Json plane(const Between& between, int a, int b, const Eigen::Vector3d& direction) const;
  Json besideFlat(const verify::PairMotion& motion, std::size_t flat) const;

  const verify::Model& model_;
  const verify::Motion& motion_;
  verify::PairToProve pair_;
  SearchedBody& a_;
  SearchedBody& b_;
  double keep_;
  const std::stop_token& stop_;
};

}  // namespace swept
