// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "error_table_depth.hpp"
#include "error_table_membership.hpp"
#include "error_table_reproducer.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/signed_distance.hpp"

namespace error_table {

/// Relative to the size of a pair, the larger extent plus the offset: the tolerance that queries
/// are asked for. Some times the rounding that they allow for.
inline constexpr double kAsked = 1e-13;

/// Times the rounding of one support evaluation, which two bodies and the placing of pieces have
/// more than one of: bodies this close may be said to touch. Points that witness an `upper` > 0 are
/// rounded, too; depths allow for all of it.
inline constexpr double kTouching = 4.0;

/// Errors relative to the size of each pair.
struct Column {
  std::vector<double> errors;
  double worst = -1.0;
  std::string worstCase;  ///< C++
};

/// An answer that breaks its promise.
struct Wrong {
  int count = 0;
  double worst = 0.0;     ///< relative
  std::string worstCase;  ///< C++
};

struct Row {
  Column distance, depth, witness;
  std::map<std::string, Wrong> wrong;
  std::array<int, kFeatures> featuresA{}, featuresB{};
};

/// Asks the library about one placement and judges the answers.
class Judge {
 public:
  Judge(const Solid& a, const Solid& b, const Placement& placement, Row& row)
      : a_(a),
        b_(b),
        pose_(placement.a_from_b),
        turn_(pose_.linear()),
        truth_(placement.truth),
        size_(std::max(a.body.extent, b.body.extent) + pose_.translation().norm()),
        rounding_(kTouching * swept::tolerance::kSupportRounding *
                  (std::sqrt(3.0) * (a.body.extent + b.body.extent) + pose_.translation().norm())),
        row_(row) {}

  /// Of two that are apart, or touch.
  void distances() {
    const auto found = swept::distance(a_.shape, b_.shape, pose_, options());
    const Real zero = 0;
    const Truth apart{std::max(zero, truth_.lower), std::max(zero, truth_.upper)};
    interval("distance", found, apart, row_.distance);
    witness("distance", found, apart);
    const auto both = swept::signedDistance(a_.shape, b_.shape, pose_, kAsked * size_);
    interval("signedDistance", both, truth_, row_.distance);
  }

  /// Of two that overlap. `search`: the depth is not known yet.
  void depths(bool search) {
    const auto found = swept::signedDistance(a_.shape, b_.shape, pose_, kAsked * size_);
    if (search) truth_ = DeepestOverlap(a_.body, b_.body, pose_).run(found.normal);
    if (truth_.upper > 0) return;  // beyond the plane that it was to cross
    interval("signedDistance", found, truth_, row_.depth);
    // Of meshes in overlap the points are those that witness `upper`.
    if (!isMesh(a_) && !isMesh(b_)) witness("signedDistance", found, truth_);
    const auto apart = swept::distance(a_.shape, b_.shape, pose_, options());
    interval("distance", apart, {0, 0}, row_.distance);
  }

 private:
  static bool isMesh(const Solid& solid) {
    return std::holds_alternative<swept::TriangleMesh>(solid.shape);
  }
  swept::DistanceOptions options() const {
    swept::DistanceOptions options;
    options.tolerance = kAsked * size_;
    return options;
  }
  double relative(const Real& error) const { return (error / size_).convert_to<double>(); }

  /// m, beyond the truth.
  static Real off(const Real& value, const Truth& truth) {
    return std::max({Real(0), Real(value - truth.upper), Real(truth.lower - value)});
  }

  /// The error is that of the farther end.
  template <class Result>
  void interval(const char* query, const Result& found, const Truth& truth, Column& column) {
    const bool finite = std::isfinite(found.lower) && std::isfinite(found.upper);
    if (!(finite && found.lower <= found.upper)) {
      wrong(query, "no finite interval", size_, found, truth);
      return;
    }
    if (Real(found.lower) > truth.upper) {
      wrong(query, "lower above the truth", found.lower - truth.upper, found, truth);
    }
    const Real allowed = truth.upper < -rounding_ ? 0.0 : rounding_;
    if (Real(found.upper) < truth.lower - allowed) {
      wrong(query, "upper below the truth", truth.lower - found.upper, found, truth);
    }
    note(std::max(off(Real(found.lower), truth), off(Real(found.upper), truth)), query, "interval",
         found, truth, column);
  }

  /// The points belong to the bodies and are as far apart as the truth.
  template <class Result>
  void witness(const char* query, const Result& found, const Truth& truth) {
    const Point a = real(found.pointA);
    const Point b = real(found.pointB);
    const Point local = turn_.inverse(b - real(Vector3d(pose_.translation())));
    const Real apart = truth.upper < 0 ? Real(-length(b - a)) : length(b - a);
    note(distanceTo(a_.body, a), query, "pointA to A", found, truth, row_.witness);
    note(distanceTo(b_.body, local), query, "pointB to B", found, truth, row_.witness);
    note(off(apart, truth), query, "|pointB - pointA|", found, truth, row_.witness);
  }

  template <class Result>
  void note(const Real& error, const char* query, const char* what, const Result& found,
            const Truth& truth, Column& column) {
    column.errors.push_back(relative(error));
    if (column.errors.back() <= column.worst) return;
    column.worst = column.errors.back();
    column.worstCase = describe(query, what, found, truth);
  }

  template <class Result>
  void wrong(const std::string& query, const std::string& what, const Real& by, const Result& found,
             const Truth& truth) {
    Wrong& wrong = row_.wrong[query + ": " + what];
    if (wrong.count++ > 0 && !(relative(by) > wrong.worst)) return;
    wrong.worst = relative(by);
    wrong.worstCase = describe(query, what, found, truth);
  }

  template <class Result>
  std::string describe(const std::string& query, const std::string& what, const Result& found,
                       const Truth& truth) const {
    const auto number = Reproducer::number;
    return Reproducer::of(a_.shape, b_.shape, pose_) + "  // " + query + ", tolerance " +
           number(kAsked * size_) + ", gives [" + number(found.lower) + ", " + number(found.upper) +
           "] in " + std::to_string(found.iterations) + " iterations;\n  // the truth is in [" +
           truth.lower.str(25) + ", " + truth.upper.str(25) + "]: " + what + "\n";
  }

  const Solid& a_;
  const Solid& b_;
  const Isometry3d pose_;
  const ExactTurn turn_;
  Truth truth_;
  const double size_;
  /// m. How far `upper` may be below the truth, but for depths.
  const double rounding_;
  Row& row_;
};

}  // namespace error_table
