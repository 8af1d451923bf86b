// SPDX-License-Identifier: BSD-3-Clause
#include "point_cloud/line_cell.hpp"

#include <algorithm>
#include <cmath>

#include "point_cloud/gaussian.hpp"

namespace swept::detail {

namespace {

constexpr int kMiddle = 4;                     // of the lines; 0 to 3 are the corners
constexpr std::size_t kMostCertificates = 24;  // of a cell

/// An affine function of (u, v) that bounds the end of a certificate from one side.
struct AffineEnd {
  double middle = 0.0;              ///< at the rectangle's mean
  double variance = 0.0;            ///< over the rectangle
  std::array<double, 4> corners{};  ///< values

  /// Bound on the difference between the mean of P(w <= function) and P(w <= middle).
  double error() const {
    if (std::isinf(middle)) return 0.0;
    double reach = 0.0;
    for (const double corner : corners) reach = std::max(reach, std::abs(corner - middle));
    return 0.5 * cdfCurvature(middle, reach) * variance;
  }
};

/// A certificate along the five lines.
struct Seen {
  const Certificate* certificate = nullptr;
  std::array<Interval, 5> on;

  bool isAnywhere() const {
    return std::any_of(on.begin(), on.end(), [](const Interval& i) { return !i.isEmpty(); });
  }
  bool isOnAllLines() const {
    return std::none_of(on.begin(), on.end(), [](const Interval& i) { return i.isEmpty(); });
  }
  bool contains(const Seen& other) const {
    for (std::size_t k = 0; k < on.size(); ++k) {
      if (other.on[k].isEmpty()) continue;
      if (!(on[k].from <= other.on[k].from && other.on[k].to <= on[k].to)) return false;
    }
    return true;
  }
  /// Whether the two have a common point on every line of the cell: by convexity, if they do at the
  /// corners.
  bool meets(const Seen& other) const {
    for (std::size_t k = 0; k < kMiddle; ++k) {
      if (!(on[k].from <= other.on[k].to && other.on[k].from <= on[k].to)) return false;
    }
    return true;
  }
};

std::array<double, 2> cornerOf(const LineCell& cell, std::size_t corner) {
  return {(corner & 1U) != 0 ? cell.to[0] : cell.from[0],
          (corner & 2U) != 0 ? cell.to[1] : cell.from[1]};
}

std::vector<Seen> look(const NoiseFrame& frame, const LineCell& cell) {
  std::array<Eigen::Vector3d, 5> lines;
  for (std::size_t k = 0; k < kMiddle; ++k) {
    const auto corner = cornerOf(cell, k);
    lines[k] = frame.line(corner[0], corner[1]);
  }
  lines[kMiddle] = frame.line(cell.mean[0], cell.mean[1]);
  const Eigen::Vector3d way = frame.way();
  std::vector<Seen> seen;
  seen.reserve(cell.certificates.size());
  for (const Certificate& certificate : cell.certificates) {
    Seen one{&certificate, {}};
    for (std::size_t k = 0; k < lines.size(); ++k) one.on[k] = certificate.along(lines[k], way);
    if (one.isAnywhere()) seen.push_back(one);
  }
  return seen;
}

/// An affine function below a concave function (or, with `below` false, above a convex one) with
/// these values at the corners.
AffineEnd affineEnd(const LineCell& cell, const std::array<double, 4>& values, bool below) {
  AffineEnd end;
  if (std::isinf(values[0])) {  // a half-space, whose ends are infinite everywhere
    end.middle = values[0];
    end.corners = values;
    return end;
  }
  const double u = (values[1] + values[3] - values[0] - values[2]) / 2.0;
  const double v = (values[2] + values[3] - values[0] - values[1]) / 2.0;
  const double slopeU = u / (cell.to[0] - cell.from[0]);
  const double slopeV = v / (cell.to[1] - cell.from[1]);
  std::array<double, 4> rise{};
  for (std::size_t k = 0; k < kMiddle; ++k) {
    const auto corner = cornerOf(cell, k);
    rise[k] = slopeU * (corner[0] - cell.mean[0]) + slopeV * (corner[1] - cell.mean[1]);
    const double middle = values[k] - rise[k];
    if (k == 0 || (below ? middle < end.middle : middle > end.middle)) end.middle = middle;
  }
  for (std::size_t k = 0; k < kMiddle; ++k) end.corners[k] = end.middle + rise[k];
  end.variance = slopeU * slopeU * cell.variance[0] + slopeV * slopeV * cell.variance[1];
  return end;
}

AffineEnd endOf(const LineCell& cell, const Seen& seen, bool upper) {
  std::array<double, 4> values{};
  for (std::size_t k = 0; k < kMiddle; ++k) values[k] = upper ? seen.on[k].to : seen.on[k].from;
  return affineEnd(cell, values, upper);
}

/// Overlapping certificates of one kind, one after the other: everything between the two ends is
/// proven.
struct Segment {
  AffineEnd from;
  AffineEnd to;

  double mass() const {
    const double between = normalCdf(to.middle) - normalCdf(from.middle);
    return std::max(0.0, between - from.error() - to.error());
  }
  bool isApartFrom(const Segment& other) const {
    return isBelow(to, other.from) || isBelow(other.to, from);
  }

 private:
  static bool isBelow(const AffineEnd& a, const AffineEnd& b) {
    for (std::size_t k = 0; k < kMiddle; ++k) {
      if (!(a.corners[k] <= b.corners[k])) return false;
    }
    return true;
  }
};

/// `seen` is sorted along the middle line.
std::vector<Segment> segments(const LineCell& cell, const std::vector<Seen>& seen, bool occurs) {
  std::vector<Segment> chains;
  const Seen* farthest = nullptr;  // of the last chain
  for (const Seen& next : seen) {
    if (next.certificate->occurs != occurs || !next.isOnAllLines()) continue;
    const Segment alone{endOf(cell, next, false), endOf(cell, next, true)};
    if (farthest == nullptr || !farthest->meets(next)) {
      chains.push_back(alone);
      farthest = &next;
      continue;
    }
    Segment& chain = chains.back();
    if (alone.from.middle < chain.from.middle) chain.from = alone.from;
    if (alone.to.middle > chain.to.middle) {
      chain.to = alone.to;
      farthest = &next;
    }
  }
  return chains;
}

/// For a convex event: if every corner's line has a point of it, everything between these points is
/// in it.
std::vector<Segment> hullOf(const LineCell& cell, const std::vector<Seen>& seen) {
  Seen hull;
  for (const Seen& one : seen) {
    if (!one.certificate->occurs) continue;
    for (std::size_t k = 0; k < kMiddle; ++k) {
      hull.on[k].from = std::min(hull.on[k].from, one.on[k].from);
      hull.on[k].to = std::max(hull.on[k].to, one.on[k].to);
    }
  }
  for (std::size_t k = 0; k < kMiddle; ++k) {
    if (hull.on[k].isEmpty()) return {};
  }
  return {{endOf(cell, hull, false), endOf(cell, hull, true)}};
}

/// The proven probability; segments that overlap without chaining to each other count once.
double provenMass(std::vector<Segment> chains) {
  std::sort(chains.begin(), chains.end(),
            [](const Segment& a, const Segment& b) { return a.mass() > b.mass(); });
  double mass = 0.0;
  std::vector<Segment> counted;
  for (const Segment& chain : chains) {
    const bool apart = std::all_of(counted.begin(), counted.end(),
                                   [&](const Segment& other) { return chain.isApartFrom(other); });
    if (!apart) continue;
    mass += chain.mass();
    counted.push_back(chain);
  }
  return std::min(1.0, mass);
}

/// Calls gap(interval, known occurrence before, after) for each part of the middle line without a
/// certificate. Returns the probability of the part known to occur. `seen` is sorted along that
/// line.
template <typename OnGap>
double walkMiddle(const std::vector<Seen>& seen, const OnGap& gap) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double reached = -kInfinity;
  double occurring = 0.0;
  const Certificate* before = nullptr;
  for (const Seen& next : seen) {
    const Interval& on = next.on[kMiddle];
    if (on.isEmpty() || on.to <= reached) continue;
    if (on.from > reached) gap(Interval{reached, on.from}, before, next.certificate);
    if (next.certificate->occurs) {
      occurring += normalCdf(on.to) - normalCdf(std::max(on.from, reached));
    }
    reached = on.to;
    before = next.certificate;
  }
  if (reached < kInfinity) gap(Interval{reached, kInfinity}, before, nullptr);
  return occurring;
}

/// The share of a gap of the middle line that belongs to its start: up to where the boundary seems
/// to be.
double shareOfStart(const NoiseFrame& frame, const LineCell& cell, const Interval& gap) {
  if (!cell.boundary) return 0.5;
  const Eigen::Vector3d origin = frame.line(cell.mean[0], cell.mean[1]);
  const double slope = cell.boundary->outward.dot(frame.way());
  const double crossing = cell.boundary->outward.dot(cell.boundary->point - origin) / slope;
  if (!std::isfinite(crossing)) return 0.5;
  const double before = normalCdf(std::clamp(crossing, gap.from, gap.to)) - normalCdf(gap.from);
  const double mass = normalCdf(gap.to) - normalCdf(gap.from);
  return mass > 0.0 ? before / mass : 0.5;
}

/// Uses the middle line: a gap whose ends agree is like its ends, other gaps are divided.
double middleEstimate(const NoiseFrame& frame, const LineCell& cell,
                      const std::vector<Seen>& seen) {
  double shared = 0.0;
  const double occurring = walkMiddle(
      seen, [&](const Interval& gap, const Certificate* before, const Certificate* after) {
        const Certificate* start = before != nullptr ? before : after;
        const Certificate* end = after != nullptr ? after : before;
        const double mass = normalCdf(gap.to) - normalCdf(gap.from);
        const double first = shareOfStart(frame, cell, gap);
        if (start == nullptr || start->occurs) shared += first * mass;
        if (end != nullptr && end->occurs) shared += (1.0 - first) * mass;
      });
  return occurring + shared;
}

void sortAlongMiddle(std::vector<Seen>& seen) {
  std::stable_sort(seen.begin(), seen.end(), [](const Seen& a, const Seen& b) {
    return a.on[kMiddle].from < b.on[kMiddle].from;
  });
}

/// Keeps the newest: they were made closer to the relevant places.
void keepUseful(LineCell& cell, std::vector<Seen>& seen) {
  std::vector<Seen> kept;
  for (std::size_t i = seen.size(); i-- > 0 && kept.size() < kMostCertificates;) {
    bool useful = true;
    for (std::size_t k = 0; k < seen.size() && useful; ++k) {
      const bool before = k < i && seen[i].contains(seen[k]);
      useful = k == i || !seen[k].contains(seen[i]) || before;
    }
    if (useful) kept.push_back(seen[i]);
  }
  std::reverse(kept.begin(), kept.end());
  std::vector<Certificate> certificates;
  certificates.reserve(kept.size());
  for (const Seen& one : kept) certificates.push_back(*one.certificate);
  cell.certificates = std::move(certificates);
  for (std::size_t i = 0; i < kept.size(); ++i) kept[i].certificate = &cell.certificates[i];
  seen = std::move(kept);
}

}  // namespace

// The variance of a unimodal distribution on an interval is at most a ninth of its square
// (Jacobson: The Maximum Variance of Restricted Unimodal Distributions, 1969). The variance of a
// normal distribution truncated at both sides is at most that of the whole.
LineCell LineCell::of(const std::array<double, 2>& from, const std::array<double, 2>& to) {
  LineCell cell;
  cell.from = from;
  cell.to = to;
  cell.mass = 1.0;
  for (std::size_t k = 0; k < 2; ++k) {
    const double width = to[k] - from[k];
    // Of the lighter tail, where differences of small numbers keep their digits.
    const bool right = from[k] + to[k] > 0.0;
    const double mass =
        right ? normalCdf(-from[k]) - normalCdf(-to[k]) : normalCdf(to[k]) - normalCdf(from[k]);
    cell.mass *= mass;
    cell.mean[k] =
        std::clamp((normalDensity(from[k]) - normalDensity(to[k])) / mass, from[k], to[k]);
    cell.variance[k] = std::min(1.0, width * width / 9.0);
  }
  cell.most = cell.mass;
  cell.estimate = 0.5 * cell.mass;
  return cell;
}

void bound(const NoiseFrame& frame, LineCell& cell) {
  std::vector<Seen> seen = look(frame, cell);
  keepUseful(cell, seen);
  sortAlongMiddle(seen);
  const double occurs =
      provenMass(frame.isConvex ? hullOf(cell, seen) : segments(cell, seen, true));
  const double free = provenMass(segments(cell, seen, false));
  cell.least = std::max(cell.least, cell.mass * occurs);
  cell.most = std::min(cell.most, cell.mass * (1.0 - free));
  cell.most = std::max(cell.most, cell.least);
  cell.estimate = std::clamp(cell.mass * middleEstimate(frame, cell, seen), cell.least, cell.most);
}

LineGap widestGap(const NoiseFrame& frame, const LineCell& cell) {
  std::vector<Seen> seen = look(frame, cell);
  sortAlongMiddle(seen);
  LineGap widest;
  walkMiddle(seen, [&](const Interval& where, const Certificate*, const Certificate*) {
    const bool right = where.from > 0.0;
    const double mass = right ? normalCdf(-where.from) - normalCdf(-where.to)
                              : normalCdf(where.to) - normalCdf(where.from);
    if (mass > widest.mass) widest = {where, mass};
  });
  return widest;
}

}  // namespace swept::detail
