// SPDX-License-Identifier: BSD-3-Clause
#include "io/collada_transform.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "io/mesh_claim.hpp"
#include "text/numbers.hpp"

namespace swept::detail {

namespace {

using tinyxml2::XMLElement;

constexpr double kUnitAxis = 1e-3;  ///< more is no rounding but a mistake

std::vector<double> numbers(const XMLElement& element, std::size_t count,
                            const InputSource& source) {
  std::vector<double> values;
  MeshClaim unused;
  for (const std::string_view word : colladaWords(element, source)) {
    const auto value = unused.coordinate(word);
    if (!value) failElement(source, element, "holds more than finite numbers");
    values.push_back(*value);
  }
  if (values.size() != count)
    failElement(source, element,
                "has " + std::to_string(values.size()) + " numbers; " + std::to_string(count) +
                    " have to be there");
  return values;
}

}  // namespace

bool isColladaTransform(std::string_view name) {
  return name == "translate" || name == "rotate" || name == "scale" || name == "matrix";
}

Eigen::Matrix4d colladaTransform(const XMLElement& element, const InputSource& source) {
  const std::string_view name = element.Name();
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  if (name == "translate") {
    result.translation() = Eigen::Vector3d::Map(numbers(element, 3, source).data());
  } else if (name == "scale") {
    result.linear() = Eigen::Vector3d::Map(numbers(element, 3, source).data()).asDiagonal();
  } else if (name == "rotate") {
    const auto values = numbers(element, 4, source);
    const Eigen::Vector3d axis = Eigen::Vector3d::Map(values.data());
    if (values[3] == 0.0) return result.matrix();
    // Assimp takes the axis for a unit vector.
    if (std::abs(axis.norm() - 1.0) > kUnitAxis)
      failElement(source, element,
                  "has an axis whose length is " + formatNumber(axis.norm()) + "; it must be 1");
    result.linear() = Eigen::AngleAxisd(values[3] * std::numbers::pi / 180.0, axis.normalized())
                          .toRotationMatrix();
  } else if (name == "matrix") {
    const auto values = numbers(element, 16, source);
    const Eigen::Matrix4d matrix =
        Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data());
    if (matrix.row(3) != Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0))
      failElement(source, element, "has a last row other than 0 0 0 1");
    return matrix;
  }
  return result.matrix();
}

}  // namespace swept::detail
