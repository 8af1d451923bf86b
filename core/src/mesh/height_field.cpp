// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/height_field.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "swept/core/floating_point_environment.hpp"

namespace swept {
namespace {

void requireSize(const char* name, double size) {
  if (size > 0.0 && std::isfinite(size)) return;
  std::ostringstream message;
  message << "height field " << name << " is " << size << "; allowed: finite and greater than 0";
  throw std::invalid_argument(message.str());
}

void requireHeights(const Eigen::MatrixXd& heights, double base) {
  std::ostringstream message;
  if (heights.rows() < 2 || heights.cols() < 2) {
    message << "height field has " << heights.rows() << " rows and " << heights.cols()
            << " columns; allowed: at least 2 of each";
    throw std::invalid_argument(message.str());
  }
  if (!std::isfinite(base)) {
    message << "height field base is " << base << "; allowed: finite";
    throw std::invalid_argument(message.str());
  }
  for (int row = 0; row < heights.rows(); ++row) {
    for (int column = 0; column < heights.cols(); ++column) {
      const double height = heights(row, column);
      if (height > base && std::isfinite(height)) continue;
      message << "height field has height " << height << " in row " << row << ", column " << column
              << "; allowed: finite and greater than the base, " << base;
      throw std::invalid_argument(message.str());
    }
  }
}

/// Both ends are exact, so that fields of one size share their borders.
double coordinate(double size, int index, int count) {
  if (index == count - 1) return 0.5 * size;
  return size * (static_cast<double>(index) / (count - 1) - 0.5);
}

/// The border's nodes, counter-clockwise seen from above.
std::vector<int> borderOf(int rows, int columns) {
  std::vector<int> border;
  for (int c = 0; c < columns - 1; ++c) border.push_back(c);
  for (int r = 0; r < rows - 1; ++r) border.push_back(r * columns + columns - 1);
  for (int c = columns - 1; c > 0; --c) border.push_back((rows - 1) * columns + c);
  for (int r = rows - 1; r > 0; --r) border.push_back(r * columns);
  return border;
}

}  // namespace

TriangleMesh heightField(double xSize, double ySize, const Eigen::MatrixXd& heights, double base) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&, xSize, ySize, base] { return heightField(xSize, ySize, heights, base); });
  }
  requireSize("x size", xSize);
  requireSize("y size", ySize);
  requireHeights(heights, base);
  const int rows = static_cast<int>(heights.rows()), columns = static_cast<int>(heights.cols());

  std::vector<Eigen::Vector3d> vertices;
  std::vector<TriangleMesh::Triangle> triangles;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c)
      vertices.emplace_back(coordinate(xSize, c, columns), coordinate(ySize, r, rows),
                            heights(r, c));
  }
  for (int r = 0; r + 1 < rows; ++r) {
    for (int c = 0; c + 1 < columns; ++c) {
      const int corner = r * columns + c;
      triangles.emplace_back(corner, corner + 1, corner + columns + 1);
      triangles.emplace_back(corner, corner + columns + 1, corner + columns);
    }
  }

  // Walls, and below them a fan: the bottom is flat and convex, whatever the nodes on its border.
  const std::vector<int> border = borderOf(rows, columns);
  const int firstBelow = static_cast<int>(vertices.size()), count = static_cast<int>(border.size());
  for (const int top : border) {
    const Eigen::Vector3d above = vertices[static_cast<std::size_t>(top)];
    vertices.emplace_back(above.x(), above.y(), base);
  }
  const int middle = static_cast<int>(vertices.size());
  vertices.emplace_back(0.0, 0.0, base);
  for (int i = 0; i < count; ++i) {
    const int next = (i + 1) % count;
    const int top = border[static_cast<std::size_t>(i)];
    const int topNext = border[static_cast<std::size_t>(next)];
    triangles.emplace_back(firstBelow + i, firstBelow + next, topNext);
    triangles.emplace_back(firstBelow + i, topNext, top);
    triangles.emplace_back(middle, firstBelow + next, firstBelow + i);
  }
  return TriangleMesh::build(vertices, triangles);
}

}  // namespace swept
