// SPDX-License-Identifier: BSD-3-Clause
#include "campaign.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "../../core/error_table_reproducer.hpp"
#include "swept/core/separation.hpp"

namespace pairs {
namespace {

using swept::Contact;

/// Relative to the coordinates. What a normal may be rounded by.
constexpr double kRounding = 2e-14;
/// Likewise, of witness points: the foot on a sliver, whose normal has few digits, is off the
/// triangle's plane.
constexpr double kWitness = 1e-10;

double coordinatesOf(const Pair& pair, const Placing& placing) {
  return pair.magnitude() + placing.a_from_b.translation().cwiseAbs().sum();
}

/// m. What proves no distance wrong: planes and half-spaces may be taken for parallel, and a lower
/// bound of two is one of what is within reach (tolerance::kParallel).
Real unparallel(const Pair& pair, const Placing& placing) {
  if (!(pair.a.flat() && pair.b.flat())) return 0;
  return 2 * Real(swept::tolerance::kParallel) *
         (error_table::length(placing.onA.point) + placing.atMost);
}

/// A double that is not smaller.
double above(const Real& value) {
  return std::nextafter(value.convert_to<double>(), std::numeric_limits<double>::infinity());
}

/// m. More than the bodies are known to keep.
double requiredOf(const Pair& pair, const Placing& placing) {
  return above(placing.atMost + unparallel(pair, placing));
}

std::string number(const Real& value) {
  return value.str(25);
}

std::string compared(const char* what, double value, const Real& truth) {
  return std::string(what) + " " + number(Real(value)) + ", but two points are " + number(truth) +
         " apart";
}

/// Bounds that two points of the bodies contradict.
void judgeLower(const Pair& pair, const Placing& placing, const Answer& answer,
                std::vector<std::string>& faults) {
  const Real most = placing.atMost + unparallel(pair, placing);
  if (Real(answer.distance.lower) > most)
    faults.push_back(compared("distance: lower", answer.distance.lower, most));
  if (Real(answer.signedDistance.lower) > most)
    faults.push_back(compared("signedDistance: lower", answer.signedDistance.lower, most));
  if (answer.contact == Contact::Separate && most == 0)
    faults.emplace_back("collide: Separate, but a point is common");
  if (answer.keepsMore)
    faults.push_back(compared("separate: more than", requiredOf(pair, placing), most));
}

/// Bounds that two support planes contradict, and intervals that are none.
void judgeUpper(const Pair& pair, const Placing& placing, const Answer& answer,
                std::vector<std::string>& faults) {
  const double slack = kWitness * coordinatesOf(pair, placing);
  const auto judge = [&](const std::string& query, double lower, double upper, double least) {
    if (!(lower <= upper)) faults.push_back(query + ": no interval");
    if (upper < least - slack)
      faults.push_back(query + ": upper " + number(Real(upper)) + ", but planes " +
                       number(Real(least)) + " apart are between");
  };
  judge("distance", answer.distance.lower, answer.distance.upper, std::max(0.0, placing.atLeast));
  judge("signedDistance", answer.signedDistance.lower, answer.signedDistance.upper,
        placing.atLeast);
  if (answer.contact == Contact::Touching && placing.atLeast > slack)
    faults.emplace_back("collide: Touching, but planes are between");
}

/// A normal whose plane does not separate the spots as it says.
void judgeNormal(const Pair& pair, const Placing& placing, const Answer& answer,
                 std::vector<std::string>& faults) {
  const swept::DistanceResult& found = answer.distance;
  if (found.normal.isZero(0.0)) return;
  const Real along = error_table::real(found.normal).dot(placing.apart);
  const double slack = kRounding * coordinatesOf(pair, placing);
  if (Real(found.lower) > along + slack + unparallel(pair, placing))
    faults.push_back(compared("distance: along its normal, lower", found.lower, along));
}

std::string reproducerOf(const Pair& pair, const Placing& placing) {
  return error_table::Reproducer::of(pair.a.shape, pair.b.shape, placing.a_from_b);
}

void count(const Pair& pair, const Placing& placing, const Answer& answer, CampaignReport& report) {
  const auto a = static_cast<std::size_t>(pair.a.kind), b = static_cast<std::size_t>(pair.b.kind);
  const double size = std::max(pair.sizeA, pair.sizeB);
  const bool apart = answer.distance.lower > 0.0;
  ++report.placings;
  report.apart += apart ? 1 : 0;
  report.touching += answer.distance.upper <= 0.0 ? 1 : 0;
  report.near += apart && answer.distance.lower < 1e-9 * size ? 1 : 0;
  report.within += placing.atMost < 1e-14 * size ? 1 : 0;
  report.bounded += std::isfinite(placing.atLeast) ? 1 : 0;
  report.exact += placing.atMost == 0 ? 1 : 0;
  ++report.pairs[a][b];
  report.apartOf[a][b] += apart ? 1 : 0;
  const int decade = static_cast<int>(std::floor(std::log10(size))) + 12;
  ++report.decades[static_cast<std::size_t>(std::clamp(decade, 0, kDecades - 1))];
}

}  // namespace

Answer ask(const Pair& pair, const Placing& placing) {
  const swept::Shape &a = pair.a.shape, &b = pair.b.shape;
  // Shapes of any size are asked for as many digits.
  swept::DistanceOptions options;
  options.tolerance = 1e-13 * coordinatesOf(pair, placing);
  Answer answer;
  answer.distance = swept::distance(a, b, placing.a_from_b, options);
  answer.signedDistance = swept::signedDistance(a, b, placing.a_from_b, options.tolerance);
  answer.contact = swept::collide(a, b, placing.a_from_b);
  swept::SeparationQuery query;
  query.approach.required = requiredOf(pair, placing);
  answer.keepsMore =
      swept::separate(a, b, placing.a_from_b, query).status == swept::Separation::Separated;
  return answer;
}

std::vector<std::string> faultsOf(const Pair& pair, const Placing& placing, const Answer& answer) {
  std::vector<std::string> faults;
  judgeLower(pair, placing, answer, faults);
  judgeUpper(pair, placing, answer, faults);
  judgeNormal(pair, placing, answer, faults);
  return faults;
}

void CampaignReport::add(const CampaignReport& other) {
  placings += other.placings;
  apart += other.apart;
  touching += other.touching;
  near += other.near;
  within += other.within;
  bounded += other.bounded;
  exact += other.exact;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (std::size_t j = 0; j < pairs.size(); ++j) {
      pairs[i][j] += other.pairs[i][j];
      apartOf[i][j] += other.apartOf[i][j];
    }
  }
  for (std::size_t i = 0; i < decades.size(); ++i) decades[i] += other.decades[i];
  failures.insert(failures.end(), other.failures.begin(), other.failures.end());
}

CampaignReport runCampaign(const CampaignOptions& options) {
  CampaignReport report;
  Random random(options.seed, options.first);
  constexpr std::uint64_t kPairs = kKinds * kKinds;
  const bool all = options.kindA < 0 || options.kindB < 0;
  for (std::uint64_t k = 0; k < options.count; ++k) {
    const std::uint64_t index =
        all ? options.first + k
            : (options.first + k) * kPairs +
                  static_cast<std::uint64_t>(options.kindA * kKinds + options.kindB);
    const Pair pair = makePair(options.seed, index, random);
    for (int i = 0; i < options.placings; ++i) {
      const Placing placing = place(pair, random);
      const Answer answer = ask(pair, placing);
      count(pair, placing, answer, report);
      for (const std::string& fault : faultsOf(pair, placing, answer)) {
        report.failures.push_back("pair_refute --seed " + std::to_string(options.seed) +
                                  " --first " + std::to_string(index) + " (placing " +
                                  std::to_string(i) + "): " + fault + "\n" +
                                  reproducerOf(pair, placing));
      }
    }
  }
  return report;
}

std::string summary(const CampaignReport& report) {
  std::ostringstream text;
  text << report.placings << " placings: " << report.apart << " apart (" << report.near
       << " by less than 1e-9 of the size), " << report.touching << " touching, " << report.within
       << " with spots within 1e-14 of the size, " << report.exact << " with a common point, "
       << report.bounded << " known from below; " << report.failures.size() << " refuted";
  return text.str();
}

}  // namespace pairs
