// SPDX-License-Identifier: BSD-3-Clause
#include "cover/posed_body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/nearest_rotation.hpp"
#include "swept/core/bv/aabb.hpp"

namespace swept::detail {
namespace {

using Eigen::Vector3d;

constexpr double kRounding = 1e-14;

double sourceErrorOf(const Shape& shape) {
  const auto* mesh = std::get_if<TriangleMesh>(&shape);
  return mesh != nullptr ? mesh->sourceError() : 0.0;
}

}  // namespace

double BodyPiece::farthest(const Vector3d& center) const {
  double squared = 0.0;
  for (const Vector3d& point : content) squared = std::max(squared, (point - center).squaredNorm());
  return (std::sqrt(squared) + blur) * (1.0 + kRounding) +
         kRounding * center.lpNorm<Eigen::Infinity>();
}

PosedBody::Part::Part(const PosedShape& posed)
    : solid(posed.shape),
      cells(solid),
      body_from_shape(rigidPose(posed.body_from_shape)),
      shape_from_body(body_from_shape.inverse()),
      sourceError(sourceErrorOf(posed.shape)) {
  const double reach =
      solid.scale() + body_from_shape.translation().lpNorm<Eigen::Infinity>() + solid.inflation();
  blur = solid.inflation() + solid.pad() + sourceError + kRounding * reach;
}

PosedBody::PosedBody(std::span<const PosedShape> shapes) {
  for (const PosedShape& shape : shapes) parts_.push_back(std::make_unique<Part>(shape));
}

BodyPiece PosedBody::pieceOf(std::size_t shape, Cell cell) {
  Part& part = *parts_[shape];
  BodyPiece piece;
  piece.shape = shape;
  part.cells.gather(cell);
  for (const Vector3d& point : cell.content) piece.content.push_back(part.body_from_shape * point);
  piece.blur = cell.blur * (1.0 + kRounding) + part.blur;
  piece.middle = Aabb::fit(piece.content).center();
  piece.reach = piece.farthest(piece.middle);
  cell.content.clear();
  piece.cell = std::move(cell);
  return piece;
}

std::vector<BodyPiece> PosedBody::pieces() {
  std::vector<BodyPiece> pieces;
  for (std::size_t i = 0; i < parts_.size(); ++i)
    pieces.push_back(pieceOf(i, parts_[i]->cells.root()));
  return pieces;
}

bool PosedBody::canSplit(const BodyPiece& piece) const {
  return parts_[piece.shape]->cells.canSplit(piece.cell);
}

void PosedBody::split(const BodyPiece& piece, std::vector<BodyPiece>& out) {
  std::vector<Cell> halves;
  parts_[piece.shape]->cells.split(piece.cell, halves);
  for (Cell& half : halves) out.push_back(pieceOf(piece.shape, std::move(half)));
}

bool PosedBody::hasInside() const {
  return std::ranges::any_of(parts_, [](const auto& part) {
    return part->solid.hasInside() || part->solid.inflation() > 0.0;
  });
}

bool PosedBody::contains(const Vector3d& p) const {
  return std::ranges::any_of(parts_, [&](const auto& part) {
    const Vector3d at = part->shape_from_body * p;
    if (part->solid.inflation() > 0.0)
      return part->solid.depth(at) + part->solid.inflation() >= 0.0;
    return part->solid.hasInside() && part->solid.encloses(at);
  });
}

double PosedBody::depth(const Vector3d& p, bool pockets) const {
  double most = -std::numeric_limits<double>::infinity();
  for (const auto& part : parts_) {
    const Solid& solid = part->solid;
    const Vector3d at = part->shape_from_body * p;
    const double depth = pockets ? solid.at(at).depth : solid.depth(at);
    const double error =
        part->sourceError + kRounding * (p.lpNorm<Eigen::Infinity>() + solid.scale() +
                                         part->body_from_shape.translation().lpNorm<1>());
    most = std::max(most, depth + solid.inflation() - solid.pad() - error);
  }
  return most;
}

double PosedBody::pointError(std::size_t shape) const {
  const Part& part = *parts_[shape];
  return part.solid.slack() + part.blur - part.solid.inflation();
}

double PosedBody::leastRadius(std::size_t shape) const {
  const Solid& solid = parts_[shape]->solid;
  return std::max(0.0, solid.inflation() - solid.slack());
}

}  // namespace swept::detail
