// SPDX-License-Identifier: BSD-3-Clause
#include "sample.hpp"

namespace extremes {

namespace {

PairCase mixed(const std::string& name, double workLimit, const Wanted& wanted) {
  return {name, "ordinary", workLimit,
          [wanted](Random& random, int i) { return drawEither(random, wanted, i); }};
}

/// Either order of sizes.
PairCase ratio(const std::string& name, double small) {
  return {name, "ordinary", 3.0, [small](Random& random, int i) {
            Wanted wanted;
            (random.chance(0.5) ? wanted.sizeA : wanted.sizeB) = small;
            return drawEither(random, wanted, i);
          }};
}

/// Of shapes that have points, the points so far from the origin of their frame.
PairCase far(const std::string& name, double offset) {
  return {name, "ordinary", 3.0, [offset](Random& random, int i) {
            Wanted wanted;
            wanted.awayFromOrigin = offset;
            Sample sample = drawEither(random, wanted, i);
            sample.span = 1.0;
            return sample;
          }};
}

/// Motions of bodies that are so far from the world's origin.
PairCase away(const std::string& name, double offset) {
  return {name, "ordinary", 3.0, [offset](Random& random, int i) {
            Sample sample = drawEither(random, {}, i);
            sample.place = offset * random.direction();
            return sample;
          }};
}

/// Where the tolerance is about as large as what the coordinates are rounded by.
constexpr double kAtRounding = 100.0;

std::string power(int exponent) {
  return "1e" + std::to_string(exponent);
}

}  // namespace

std::vector<PairCase> scaleCases() {
  std::vector<PairCase> cases = {mixed("ordinary", 1.0, {})};
  // The largest work has to be that of all kinds of pairs.
  cases.back().samples = 600;
  for (const int exponent : {-9, -6, 6, 9}) {
    Wanted wanted;
    wanted.sizeA = wanted.sizeB = std::pow(10.0, exponent);
    cases.push_back(mixed("size " + power(exponent) + " m", 3.0, wanted));
  }
  for (const int exponent : {-3, -6, -9}) {
    cases.push_back(ratio("sizes 1 : " + power(exponent), std::pow(10.0, exponent)));
  }
  cases.back().motionWorkLimit = kAtRounding;
  for (const int exponent : {3, 6, 9}) {
    cases.push_back(far("corners " + power(exponent) + " m off", std::pow(10.0, exponent)));
  }
  cases.back().motionWorkLimit = kAtRounding;
  for (const int exponent : {3, 6, 9}) {
    cases.push_back(away("world " + power(exponent) + " m off", std::pow(10.0, exponent)));
  }
  cases.back().motionWorkLimit = kAtRounding;
  return cases;
}

}  // namespace extremes
