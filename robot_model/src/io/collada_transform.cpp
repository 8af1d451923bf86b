// SPDX-License-Identifier: BSD-3-Clause
#include "io/collada_transform.hpp"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "text/numbers.hpp"

namespace swept::detail {

namespace {

using tinyxml2::XMLElement;

constexpr double kUnitAxis = 1e-3;  ///< more is no rounding but a mistake

/// Of the entries of a rotation, each made of an axis and an angle in some 20 roundings, taken
/// together as one matrix, for each turn that the file has begun.
constexpr double kRotationError = 80.0 * 0x1p-53;

template <std::size_t kCount>
std::array<double, kCount> numbers(const XMLElement& element, const InputSource& source) {
  std::array<double, kCount> values{};
  std::size_t count = 0;
  forEachColladaWord(element, source, [&](std::string_view word) {
    const auto value = parseNumber(word);
    if (!value) failElement(source, element, "holds more than finite numbers");
    if (count < kCount) values[count] = *value;
    ++count;
  });
  if (count != kCount)
    failElement(source, element,
                "has " + std::to_string(count) + " numbers; " + std::to_string(kCount) +
                    " have to be there");
  return values;
}

struct Rotation {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  double error = 0.0;
};

Rotation rotationOf(const XMLElement& element, const InputSource& source) {
  const auto values = numbers<4>(element, source);
  const Eigen::Vector3d axis(values[0], values[1], values[2]);
  if (values[3] == 0.0) return {};
  // An axis that is not of unit length turns nothing in some readers, and stretches in others.
  if (!(std::abs(axis.norm() - 1.0) <= kUnitAxis))
    failElement(source, element,
                "has an axis whose length is " + formatNumber(axis.norm()) + "; it must be 1");
  // Exact: of many turns the text alone is rounded.
  const double degrees = std::remainder(values[3], 360.0);
  return {
      Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, axis.normalized()).toRotationMatrix(),
      kRotationError * std::max(1.0, std::abs(values[3]) / 360.0)};
}

}  // namespace

ColladaPlace::ColladaPlace(double unit)
    : linear_(unit * Eigen::Matrix3d::Identity()), stretch_(unit) {}

void ColladaPlace::enter(const XMLElement& element, const InputSource& source) {
  const std::string_view name = element.Name();
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  if (name == "translate") {
    offset = Eigen::Vector3d::Map(numbers<3>(element, source).data());
  } else if (name == "scale") {
    linear = Eigen::Vector3d::Map(numbers<3>(element, source).data()).asDiagonal();
  } else if (name == "rotate") {
    const Rotation rotation = rotationOf(element, source);
    linear = rotation.matrix;
    steps_ += rotation.error;
  } else if (name == "matrix") {
    const auto values = numbers<16>(element, source);
    const Eigen::Matrix4d matrix =
        Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data());
    if (matrix.row(3) != Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0))
      failElement(source, element, "has a last row other than 0 0 0 1");
    linear = matrix.topLeftCorner<3, 3>();
    offset = matrix.topRightCorner<3, 1>();
  }
  if (linear.isIdentity(0.0) && offset.isZero(0.0)) return;
  reach_ += stretch_ * offset.stableNorm();
  if (name != "translate") {
    constexpr double kNormError = 1e-12;
    stretch_ *= linear.jacobiSvd().singularValues()[0] * (1.0 + kNormError);
  }
  steps_ += kStep;
  offset_ += linear_ * offset;
  linear_ = linear_ * linear;
}

double ColladaPlace::error(double distance) const {
  return steps_ * (stretch_ * distance + reach_);
}

}  // namespace swept::detail
