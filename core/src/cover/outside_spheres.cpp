// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "cover/convex_field.hpp"
#include "cover/posed_body.hpp"
#include "cover/sphere_checks.hpp"
#include "cover/stopping.hpp"
#include "swept/core/enclosing_shapes.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {
namespace detail {

void requireSpheres(std::span<const EnclosingSphere> spheres) {
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const auto& [center, radius] = spheres[i];
    if (center.allFinite() && radius >= 0.0 && std::isfinite(radius)) continue;
    std::ostringstream message;
    message << "sphere " << i << " has the centre [" << center.transpose() << "] and the radius "
            << radius << "; allowed: finite numbers, radii of at least 0";
    throw std::invalid_argument(message.str());
  }
}

void requireSphereOption(const char* name, double value, double least, bool above) {
  if (above ? value > least : value >= least) return;
  std::ostringstream message;
  message << "option " << name << " of spheres around a body is " << value
          << "; allowed: " << (above ? "above " : "at least ") << least;
  throw std::invalid_argument(message.str());
}

}  // namespace detail

namespace {

using detail::BodyPiece;
using detail::ConvexField;
using detail::PosedBody;
using Eigen::Vector3d;

/// Divides the piece that may reach out farthest, until the bounds agree.
class OutsideSearch {
 public:
  OutsideSearch(std::span<const PosedShape> shapes, std::span<const ConvexField> fields)
      : body_(shapes), fields_(fields) {
    for (BodyPiece& piece : body_.pieces()) add(std::move(piece));
  }

  void run(const OutsideSpheresOptions& options) {
    std::vector<BodyPiece> halves;
    for (int splits = 0; splits < options.mostSplits && !open_.empty(); ++splits) {
      detail::throwIfStopped(options.stop);
      // Whether anything is outside is not left open for the tolerance's sake.
      const double upper = open_.front().upper;
      const bool isDecided = lower_ > 0.0 || !(upper > 0.0);
      if (isDecided && !(upper > lower_ + options.tolerance)) return;
      if (!body_.canSplit(open_.front().piece)) return;
      std::pop_heap(open_.begin(), open_.end(), less);
      const Open top = std::move(open_.back());
      open_.pop_back();
      halves.clear();
      body_.split(top.piece, halves);
      for (BodyPiece& half : halves) add(std::move(half));
    }
  }

  double lower() const { return lower_; }
  /// A piece that was divided is in its halves, so what is open has the bound.
  double upper() const { return open_.empty() ? lower_ : std::max(lower_, open_.front().upper); }
  const Vector3d& point() const { return point_; }

  double surfaceShare(int samples, const StopQuestion& stop) const;

 private:
  struct Open {
    double upper;
    BodyPiece piece;
  };
  static bool less(const Open& a, const Open& b) { return a.upper < b.upper; }

  void add(BodyPiece piece) {
    seePoints(piece);
    const double upper = upperOf(piece);
    // What cannot be the farthest need not be kept.
    if (!(upper > lower_)) return;
    open_.push_back({upper, std::move(piece)});
    std::push_heap(open_.begin(), open_.end(), less);
  }

  double upperOf(const BodyPiece& piece) const {
    double least = std::numeric_limits<double>::infinity();
    for (const ConvexField& field : fields_) {
      // The piece has a point within its reach of the middle, where the field is no smaller.
      if (!(field.value(piece.middle) - piece.reach < least)) continue;
      least = std::min(least, field.over(piece));
    }
    return least;
  }

  void seePoints(const BodyPiece& piece) {
    const Eigen::Isometry3d& pose = body_.pose(piece.shape);
    if (piece.cell.isSolid())
      return see(pose * Vector3d(0.5 * (piece.cell.lower + piece.cell.upper)), piece.shape);
    for (const Vector3d& corner : piece.cell.corners) see(pose * corner, piece.shape);
  }

  void see(Vector3d point, std::size_t shape) {
    const double radius = body_.leastRadius(shape);
    if (radius > 0.0) {
      const auto nearest = std::ranges::min_element(
          fields_, {}, [&](const ConvexField& field) { return field.value(point); });
      point += radius * nearest->outward(point);
    }
    const double error = body_.pointError(shape) + 1e-14 * point.lpNorm<1>();
    const double outside = detail::outsideAll(point, fields_) - error;
    if (!(outside > lower_)) return;
    lower_ = outside;
    point_ = point;
  }

  PosedBody body_;
  std::span<const ConvexField> fields_;
  std::vector<Open> open_;  ///< a heap
  double lower_ = -std::numeric_limits<double>::infinity();
  Vector3d point_ = Vector3d::Zero();
};

/// Of points spread over the triangles by area; of clouds, over their points.
double OutsideSearch::surfaceShare(int samples, const StopQuestion& stop) const {
  double out = 0.0;
  double all = 0.0;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform;
  const auto count = [&](const Vector3d& point, std::size_t shape, double weight) {
    all += weight;
    if (detail::outsideAll(body_.pose(shape) * point, fields_) > body_.pointError(shape))
      out += weight;
  };
  const auto areaOf = [](std::span<const Vector3d> vertices, const Eigen::Vector3i& t) {
    return 0.5 * (vertices[t[1]] - vertices[t[0]]).cross(vertices[t[2]] - vertices[t[0]]).norm();
  };
  double area = 0.0;
  for (std::size_t shape = 0; shape < body_.shapeCount(); ++shape)
    for (const Eigen::Vector3i& t : body_.solid(shape).triangles())
      area += areaOf(body_.solid(shape).vertices(), t);
  for (std::size_t shape = 0; shape < body_.shapeCount(); ++shape) {
    const auto vertices = body_.solid(shape).vertices();
    const auto triangles = body_.solid(shape).triangles();
    if (triangles.empty() && area == 0.0)
      for (const Vector3d& vertex : vertices) count(vertex, shape, 1.0);
    for (const Eigen::Vector3i& t : triangles) {
      const double own = areaOf(vertices, t);
      const auto points = static_cast<int>(std::ceil(samples * own / area));
      for (int i = 0; i < points; ++i) {
        detail::throwIfStopped(stop);
        const double u = std::sqrt(uniform(random));
        const double v = uniform(random);
        count((1.0 - u) * vertices[t[0]] + u * (1.0 - v) * vertices[t[1]] + u * v * vertices[t[2]],
              shape, own / points);
      }
    }
  }
  return all > 0.0 ? out / all : 0.0;
}

}  // namespace

OutsideSpheres detail::outsideFields(std::span<const PosedShape> body,
                                     std::span<const ConvexField> fields,
                                     const OutsideSpheresOptions& options) {
  requireSphereOption("tolerance", options.tolerance, 0.0, true);
  requireSphereOption("mostSplits", options.mostSplits, 0.0);
  requireSphereOption("samples", options.samples, 0.0);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (body.empty()) return {-kInfinity, -kInfinity, Vector3d::Zero(), 0.0};
  if (fields.empty()) {
    PosedBody shapes(body);
    return {kInfinity, kInfinity, shapes.pieces().front().middle, 1.0};
  }
  OutsideSearch search(body, fields);
  search.run(options);
  return {search.lower(), search.upper(), search.point(),
          search.surfaceShare(options.samples, options.stop)};
}

OutsideSpheres outsideSpheres(std::span<const PosedShape> body,
                              std::span<const EnclosingSphere> spheres,
                              const OutsideSpheresOptions& options) {
  if (detail::inForeignEnvironment())
    return inDefaultEnvironment([&] { return outsideSpheres(body, spheres, options); });
  detail::requireSpheres(spheres);
  return detail::outsideFields(body, detail::fieldsOf(spheres), options);
}

OutsideSpheres outsideShapes(std::span<const PosedShape> body, std::span<const PosedShape> shapes,
                             const OutsideSpheresOptions& options) {
  if (detail::inForeignEnvironment())
    return inDefaultEnvironment([&] { return outsideShapes(body, shapes, options); });
  return detail::outsideFields(body, detail::fieldsOf(shapes), options);
}

}  // namespace swept
