// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/clearance_grid.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "clearance_grid/build_field.hpp"
#include "clearance_grid/grid_bounds.hpp"
#include "geometry/error_model.hpp"
#include "geometry/point_text.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {

using detail::ClearanceField;
using detail::kGridRounding;
using Eigen::Vector3d;

namespace {

/// m. Coordinates whose squares are far from overflowing.
constexpr double kFar = 1e150;

/// x, y and z, in two vector registers; z is in both places of its own. Queries do not branch: the
/// points are as good as random, and a wrong branch prediction takes as long as everything else.
struct Lanes {
  Eigen::Array2d xy;
  Eigen::Array2d z;

  static Lanes of(const Vector3d& v) { return {v.head<2>(), Eigen::Array2d::Constant(v.z())}; }
  static Lanes all(double value) {
    return {Eigen::Array2d::Constant(value), Eigen::Array2d::Constant(value)};
  }
  Lanes operator+(const Lanes& b) const { return {xy + b.xy, z + b.z}; }
  Lanes operator-(const Lanes& b) const { return {xy - b.xy, z - b.z}; }
  Lanes operator*(double by) const { return {xy * by, z * by}; }
  Lanes within(const Lanes& low, const Lanes& high) const {
    return {xy.max(low.xy).min(high.xy), z.max(low.z).min(high.z)};
  }
  double squaredNorm() const { return xy.square().sum() + z[0] * z[0]; }
};

}  // namespace

/// What queries read, in double precision.
struct ClearanceGrid::Data {
  explicit Data(std::shared_ptr<const ClearanceField> of);

  /// m^2, of a bound on the distance; `rounding` must still be subtracted. For points that are not
  /// far.
  double squaredBound(const Vector3d& point) const;
  double rounding(double size) const { return rounding_ + kGridRounding * size; }
  double farClearance(const Vector3d& point) const;
  detail::GridView view() const;

  std::shared_ptr<const ClearanceField> field;
  Aabb box;      ///< m
  double voxel;  ///< m

 private:
  double within(const Lanes& q) const;

  Lanes origin_;      ///< m
  Lanes lower_;       ///< m, from the origin, of W
  Lanes upper_;       ///< m
  Lanes last_;        ///< voxel along each axis
  double inverse_;    ///< 1/m, of the voxel
  double cellSteps_;  ///< m, of cells
  double voxelSteps_;
  double halfDiagonal_;     ///< m, of a voxel, and a bit more
  double rounding_;         ///< m
  std::size_t cellRow_;     ///< cells
  std::size_t cellLayer_;   ///< cells
  std::size_t blockRow_;    ///< blocks
  std::size_t blockLayer_;  ///< blocks
  const std::uint32_t* cells_;
  const std::int32_t* bricks_;
  const std::uint32_t* voxels_;
};

namespace {

/// Rounds numbers from 0 to 2^31 to the nearest whole one, which is then in the lowest bits too.
class Whole {
 public:
  explicit Whole(const Lanes& numbers) : shifted_(numbers + Lanes::all(kShift)) {}
  Lanes middle() const { return shifted_ - Lanes::all(kShift) + Lanes::all(0.5); }
  std::size_t x() const { return bits(shifted_.xy[0]); }
  std::size_t y() const { return bits(shifted_.xy[1]); }
  std::size_t z() const { return bits(shifted_.z[0]); }

 private:
  static constexpr double kShift = 0x1.8p52;
  static std::size_t bits(double number) {
    return static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(number));
  }
  Lanes shifted_;
};

/// The number, or 0 if that is larger. std::max with a constant may become a branch.
inline double positive(double number) {
  return 0.5 * (number + std::abs(number));
}

double byteOf(const std::uint32_t* words, std::size_t at) {
  if constexpr (std::endian::native == std::endian::little)
    return reinterpret_cast<const unsigned char*>(words)[at];
  return static_cast<double>(words[at / 4] >> (8 * (at % 4)) & 255U);
}

}  // namespace

ClearanceGrid::Data::Data(std::shared_ptr<const ClearanceField> of)
    : field(std::move(of)),
      voxel(static_cast<double>(field->voxel)),
      inverse_(1.0 / voxel),
      cellSteps_(static_cast<double>(field->step)),
      voxelSteps_(static_cast<double>(field->fineStep)),
      halfDiagonal_(0.8661 * voxel),
      cells_(field->cells.data()),
      bricks_(field->bricks.data()),
      voxels_(field->voxels.data()) {
  const auto& [nx, ny, nz] = field->blocks;
  blockRow_ = static_cast<std::size_t>(nx);
  blockLayer_ = blockRow_ * static_cast<std::size_t>(ny);
  cellRow_ = 2 * blockRow_;
  cellLayer_ = 4 * blockLayer_;
  const Vector3d blocks(nx, ny, nz);
  origin_ = Lanes::of(field->origin);
  lower_ = Lanes::of(field->lower);
  upper_ = Lanes::of(field->upper);
  last_ = Lanes::of(4.0 * blocks) - Lanes::all(1.0);
  const Vector3d size = 4.0 * voxel * blocks;
  box = {field->origin, field->origin + size};
  rounding_ = kGridRounding * (field->origin.lpNorm<1>() + size.lpNorm<1>() + 255.0 * cellSteps_);
}

/// m, not negative; Lemma 1 of ClearanceField for the nearest voxel and its cell. The centre of the
/// cell is half a voxel's diagonal away from that of the voxel.
inline double ClearanceGrid::Data::within(const Lanes& q) const {
  const Lanes scaled = q * inverse_ - Lanes::all(0.5);
  const Whole nearest(scaled.within(Lanes::all(0.0), last_));
  const std::size_t x = nearest.x();
  const std::size_t y = nearest.y();
  const std::size_t z = nearest.z();
  const std::size_t cell = (z >> 1) * cellLayer_ + (y >> 1) * cellRow_ + (x >> 1);
  const std::size_t block = (z >> 2) * blockLayer_ + (y >> 2) * blockRow_ + (x >> 2);
  const std::size_t inBrick = (x & 3) + 4 * (y & 3) + 16 * (z & 3);
  const std::size_t at = 64 * static_cast<std::size_t>(bricks_[block]) + inBrick;
  const double byCell = byteOf(cells_, cell) * cellSteps_ - halfDiagonal_;
  const double byVoxel = byteOf(voxels_, at) * voxelSteps_;
  const double off = std::sqrt((q - nearest.middle() * voxel).squaredNorm());
  return positive((byCell > byVoxel ? byCell : byVoxel) - off);
}

detail::GridView ClearanceGrid::Data::view() const {
  const auto numbers = [](const Lanes& v) {
    return std::array<double, 3>{v.xy[0], v.xy[1], v.z[0]};
  };
  return {numbers(origin_),
          numbers(lower_),
          numbers(upper_),
          numbers(last_),
          voxel,
          inverse_,
          cellSteps_,
          voxelSteps_,
          halfDiagonal_,
          rounding_,
          kGridRounding,
          static_cast<double>(cellRow_),
          static_cast<double>(cellLayer_),
          static_cast<double>(blockRow_),
          static_cast<double>(blockLayer_),
          cells_,
          bricks_,
          voxels_};
}

/// Lemma 2 of ClearanceField.
double ClearanceGrid::Data::squaredBound(const Vector3d& point) const {
  const Lanes at = Lanes::of(point) - origin_;
  const Lanes q = at.within(lower_, upper_);
  const double inside = within(q);
  return (at - q).squaredNorm() + inside * inside;
}

/// Squares may overflow. NaN and infinite coordinates are not inside.
double ClearanceGrid::Data::farClearance(const Vector3d& point) const {
  if (!point.allFinite()) return 0.0;
  const Vector3d at = point - field->origin;
  const double beyond =
      (at - at.cwiseMax(field->lower).cwiseMin(field->upper)).lpNorm<Eigen::Infinity>();
  return beyond * (1.0 - kGridRounding);
}

namespace {

constexpr std::size_t kFewestCells = 1000;
constexpr std::size_t kMostCells = std::size_t{1} << 27;
constexpr double kLargestCoordinate =
    1e30;  // m; beyond, voxels are not representable in single precision
constexpr double kLargestBeyond = 1e40;  // m, outside the window; voxels grow with that too

void requireUsable(const ClearanceGridOptions& options) {
  std::ostringstream message;
  if (!(options.window.lower.array() <= options.window.upper.array()).all()) {
    message << "clearance grid: window is from " << detail::pointText(options.window.lower)
            << " to " << detail::pointText(options.window.upper)
            << "; allowed: no lower coordinate above the upper";
    throw std::invalid_argument(message.str());
  }
  if (options.cells < kFewestCells || options.cells > kMostCells) {
    message << "clearance grid: " << options.cells << " cells; allowed: " << kFewestCells << " to "
            << kMostCells;
    throw std::invalid_argument(message.str());
  }
}

void requireNear(const Aabb& box, const Aabb& window) {
  const Vector3d lower = box.lower.cwiseMax(window.lower);
  const Vector3d upper = box.upper.cwiseMin(window.upper);
  const double reach = lower.cwiseAbs().cwiseMax(upper.cwiseAbs()).maxCoeff();
  const double beyond = box.lower.cwiseAbs().cwiseMax(box.upper.cwiseAbs()).maxCoeff();
  std::ostringstream message;
  if (!(beyond <= kLargestBeyond)) {
    message << "clearance grid: the shape reaches " << beyond << " m; allowed: " << kLargestBeyond
            << ", and within the window " << kLargestCoordinate;
    throw std::invalid_argument(message.str());
  }
  if (reach <= kLargestCoordinate) return;
  message << "clearance grid: the shape reaches " << reach
          << " m within the window; allowed: " << kLargestCoordinate;
  throw std::invalid_argument(message.str());
}

std::string nameOf(const Shape& shape) {
  constexpr std::array<const char*, 12> kNames = {
      "sphere",      "box",      "cylinder", "capsule",    "cone", "ellipsoid",
      "convex hull", "triangle", "plane",    "half-space", "mesh", "point cloud"};
  static_assert(std::variant_size_v<Shape> == kNames.size());
  return kNames[shape.index()];
}

template <typename Body>
std::shared_ptr<const ClearanceField> fieldOf(const Body& body,
                                              const ClearanceGridOptions& options) {
  const Aabb box = detail::fieldBox(body);
  const Aabb window = box.overlaps(options.window) ? options.window : box;
  requireNear(box, window);
  return detail::buildField(body, window, options.cells);
}

}  // namespace

ClearanceGrid ClearanceGrid::build(const Shape& shape, const ClearanceGridOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return build(shape, options); });
  }
  requireUsable(options);
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape))
    return ClearanceGrid(std::make_shared<const Data>(fieldOf(*mesh, options)));
  if (const auto* cloud = std::get_if<PointCloud>(&shape))
    return ClearanceGrid(std::make_shared<const Data>(fieldOf(*cloud, options)));
  throw std::invalid_argument(std::string("clearance grid: the shape is of kind ") + nameOf(shape) +
                              "; allowed: mesh, point cloud");
}

double ClearanceGrid::clearance(const Vector3d& point) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return clearance(point); });
  }
  const double size = point.lpNorm<1>();
  if (!(size < kFar)) return data_->farClearance(point);
  return positive(std::sqrt(data_->squaredBound(point)) - data_->rounding(size));
}

void ClearanceGrid::clearances(std::span<const Vector3d> points, std::span<double> bounds) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, points, bounds] { return clearances(points, bounds); });
  }
  if (points.size() != bounds.size()) {
    std::ostringstream message;
    message << "clearance grid: " << points.size() << " points and " << bounds.size() << " bounds";
    throw std::invalid_argument(message.str());
  }
  const detail::GridView view = data_->view();
  const auto isNear = [](const Vector3d& point) { return point.lpNorm<1>() < kFar; };
  std::size_t first = 0;
  for (; first + detail::kGridLanes <= points.size(); first += detail::kGridLanes) {
    const auto some = points.subspan(first, detail::kGridLanes);
    if (std::all_of(some.begin(), some.end(), isNear)) {
      detail::gridBounds(view, some.front().data(), &bounds[first]);
    } else {
      for (std::size_t i = 0; i < some.size(); ++i) bounds[first + i] = clearance(some[i]);
    }
  }
  for (; first < points.size(); ++first) bounds[first] = clearance(points[first]);
}

/// Compares squares, whose own rounding is small beside that of the rest.
bool ClearanceGrid::isFarther(const Vector3d& center, double radius) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, radius] { return isFarther(center, radius); });
  }
  if (radius < 0.0) return center.allFinite();
  const double size = center.lpNorm<1>();
  if (!(size < kFar)) return data_->farClearance(center) > radius;
  const double asked = radius + data_->rounding(size);
  return data_->squaredBound(center) > asked * asked * (1.0 + kGridRounding);
}

double ClearanceGrid::voxel() const {
  return data_->voxel;
}
double ClearanceGrid::error() const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return error(); });
  }
  return 9.0 * data_->voxel;
}
double ClearanceGrid::reach() const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return reach(); });
  }
  return 37.0 * data_->voxel;
}
const Aabb& ClearanceGrid::box() const {
  return data_->box;
}
std::size_t ClearanceGrid::bytes() const {
  return data_->field->bytes();
}
const std::shared_ptr<const detail::ClearanceField>& ClearanceGrid::field() const {
  return data_->field;
}

}  // namespace swept
