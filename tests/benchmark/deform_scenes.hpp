// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "workloads.hpp"

/// Deforming scenes made on the spot, after the two of Pan, Chitta, Manocha 2012 (section VI,
/// Table IV): balls on a cloth, and a solid that breaks.
namespace swept::benchmark {

using Points = std::vector<Eigen::Vector3d>;

/// Objects whose vertices are a function of the frame.
class DeformScene {
 public:
  virtual ~DeformScene() = default;
  virtual int frames() const = 0;
  /// m, of one object.
  virtual Points at(std::size_t object, int frame) const = 0;

  const std::vector<std::vector<Eigen::Vector3i>>& objects() const { return objects_; }

  /// All objects as one mesh.
  std::vector<Eigen::Vector3i> allTriangles() const {
    std::vector<Eigen::Vector3i> all;
    int offset = 0;
    for (std::size_t o = 0; o < objects_.size(); ++o) {
      for (const Eigen::Vector3i& t : objects_[o]) all.emplace_back(t.array() + offset);
      offset += static_cast<int>(at(o, 0).size());
    }
    return all;
  }
  Points allAt(int frame) const {
    Points all;
    for (std::size_t o = 0; o < objects_.size(); ++o) {
      const Points points = at(o, frame);
      all.insert(all.end(), points.begin(), points.end());
    }
    return all;
  }

 protected:
  std::vector<std::vector<Eigen::Vector3i>> objects_;
};

/// Unit sphere of 20 * 4^level triangles of nearly the same size.
inline Soup icosphere(int level) {
  const double g = std::numbers::phi;
  Soup soup;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-g, g}) {
      soup.vertices.emplace_back(0.0, a, b);
      soup.vertices.emplace_back(a, b, 0.0);
      soup.vertices.emplace_back(b, 0.0, a);
    }
  }
  // The faces of the icosahedron are the triples of vertices at distance 2 of one another.
  const auto near = [&](int i, int j) {
    const auto& v = soup.vertices;
    return std::abs((v[static_cast<std::size_t>(i)] - v[static_cast<std::size_t>(j)]).norm() -
                    2.0) < 0.1;
  };
  for (int i = 0; i < 12; ++i)
    for (int j = i + 1; j < 12; ++j)
      for (int k = j + 1; k < 12; ++k)
        if (near(i, j) && near(j, k) && near(i, k)) soup.triangles.emplace_back(i, j, k);
  for (; level > 0; --level) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int i, int j) {
      const auto [at, isNew] =
          middles.try_emplace(std::minmax(i, j), static_cast<int>(soup.vertices.size()));
      if (isNew)
        soup.vertices.push_back(0.5 * (soup.vertices[static_cast<std::size_t>(i)] +
                                       soup.vertices[static_cast<std::size_t>(j)]));
      return at->second;
    };
    std::vector<Eigen::Vector3i> finer;
    for (const Eigen::Vector3i& t : soup.triangles) {
      const int a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
      finer.emplace_back(t[0], a, c);
      finer.emplace_back(t[1], b, a);
      finer.emplace_back(t[2], c, b);
      finer.emplace_back(a, b, c);
    }
    soup.triangles = std::move(finer);
    for (Eigen::Vector3d& v : soup.vertices) v.normalize();
  }
  return soup;
}

/// 26 balls of 5120 triangles that pulsate and bounce on a rippling cloth of 12,800, and through
/// one another: 145,920 triangles, 94 frames of 1/30 s.
class BallsScene : public DeformScene {
 public:
  BallsScene() : sphere_(icosphere(4)) {
    std::mt19937_64 random(26);
    for (int i = 0; i < 26; ++i) {
      Ball ball;
      ball.radius = uniform(random, 0.45, 0.75);
      ball.place = {uniform(random, -2.7, 2.7), uniform(random, -2.7, 2.7)};
      ball.drift = {uniform(random, -1.5, 1.5), uniform(random, -1.5, 1.5)};
      ball.height = uniform(random, 0.4, 2.0);
      ball.period = uniform(random, 0.8, 1.5);
      ball.phase = uniform(random, 0.0, 1.0);
      ball.lobes = uniform(random, 2.0, 6.0) * direction(random);
      ball.swing = uniform(random, 0.03, 0.12);
      ball.pulse = uniform(random, 3.0, 8.0);
      balls_.push_back(ball);
      objects_.push_back(sphere_.triangles);
    }
    cloth_ = grid(80, 80, false, false, [](double u, double v) {
      return Eigen::Vector3d(8.0 * u - 4.0, 8.0 * v - 4.0, 0.0);
    });
    objects_.push_back(cloth_.triangles);
  }

  int frames() const override { return 94; }
  Points at(std::size_t object, int frame) const override {
    const double t = frame / 30.0;
    return object < balls_.size() ? ballAt(balls_[object], t) : clothAt(t);
  }

 private:
  struct Ball {
    double radius, height, period, phase, swing, pulse;
    Eigen::Vector2d place, drift;
    Eigen::Vector3d lobes;
  };

  /// To and fro between -3 and 3.
  static double within(double x) {
    return 3.0 - std::abs(6.0 - (x + 9.0 - 12.0 * std::floor((x + 9.0) / 12.0)));
  }

  Points ballAt(const Ball& ball, double t) const {
    const double turn = t / ball.period + ball.phase;
    const double part = turn - std::floor(turn);
    const double lift = 4.0 * part * (1.0 - part);
    const Eigen::Vector3d middle(within(ball.place.x() + ball.drift.x() * t),
                                 within(ball.place.y() + ball.drift.y() * t),
                                 0.9 * ball.radius + ball.height * lift);
    const double flat = 1.0 - 0.2 * std::exp(-6.0 * lift);
    const Eigen::Vector3d stretch(1.0 / std::sqrt(flat), 1.0 / std::sqrt(flat), flat);
    Points points;
    points.reserve(sphere_.vertices.size());
    for (const Eigen::Vector3d& n : sphere_.vertices) {
      const double swell = 1.0 + ball.swing * std::sin(ball.lobes.dot(n) + ball.pulse * t);
      points.emplace_back(middle + ball.radius * swell * n.cwiseProduct(stretch));
    }
    return points;
  }
  Points clothAt(double t) const {
    Points points = cloth_.vertices;
    for (Eigen::Vector3d& p : points)
      p.z() = 0.06 * std::sin(2.2 * p.x() + 3.0 * t) * std::cos(1.8 * p.y() - 2.0 * t);
    return points;
  }

  std::vector<Ball> balls_;
  Soup sphere_, cloth_;
};

/// A block of n^3 rough pieces, each of 12 cells^2 triangles, that fit into one another but for a
/// hair, and fly apart, spin and bend from frame 5 on; 45 frames of 1/30 s.
class ShatterScene : public DeformScene {
 public:
  ShatterScene(int n, int cells) : n_(n), cells_(cells) {
    std::mt19937_64 random(45);
    for (int i = 0; i < (n + 1) * (n + 1) * (n + 1); ++i)
      jitter_.emplace_back((0.4 / n) * Eigen::Vector3d(uniform(random, -1.0, 1.0),
                                                       uniform(random, -1.0, 1.0),
                                                       uniform(random, -1.0, 1.0)));
    for (int x = 0; x < n; ++x)
      for (int y = 0; y < n; ++y)
        for (int z = 0; z < n; ++z) addPiece({x, y, z}, random);
  }

  int frames() const override { return 45; }
  Points at(std::size_t object, int frame) const override {
    const Piece& piece = pieces_[object];
    const double t = std::max(0, frame - 5) / 30.0;
    const double angle = piece.spin.norm() * t;
    const Eigen::Matrix3d turned =
        Eigen::AngleAxisd(angle, piece.spin.normalized()).toRotationMatrix();
    const Eigen::Vector3d middle =
        piece.middle + t * piece.velocity - 1.5 * t * t * Eigen::Vector3d::UnitZ();
    Points points;
    points.reserve(piece.shape.size());
    for (const Eigen::Vector3d& p : piece.shape) {
      const Eigen::Vector3d bent =
          p + piece.bend * t * (p.x() * p.x() - p.y() * p.y()) * Eigen::Vector3d::UnitZ();
      points.emplace_back(middle + turned * bent);
    }
    return points;
  }

 private:
  struct Piece {
    Points shape;  ///< m, about the middle
    Eigen::Vector3d middle, velocity, spin;
    double bend;
  };

  /// Where a point of the lattice of cells is, in units of pieces: the same for neighbours.
  Eigen::Vector3d placed(const Eigen::Vector3i& piece, const Eigen::Vector3d& part) const {
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    for (int corner = 0; corner < 8; ++corner) {
      double weight = 1.0;
      Eigen::Vector3i node = piece;
      for (int k = 0; k < 3; ++k) {
        const bool far = (corner >> k & 1) != 0;
        weight *= far ? part[k] : 1.0 - part[k];
        node[k] += far ? 1 : 0;
      }
      const int index = (node.x() * (n_ + 1) + node.y()) * (n_ + 1) + node.z();
      p += weight * ((2.0 / n_) * node.cast<double>() + jitter_[static_cast<std::size_t>(index)]);
    }
    const Eigen::Vector3d wave(std::sin(9.0 * p.y() + 5.0 * p.z()),
                               std::sin(8.0 * p.z() + 4.0 * p.x()),
                               std::sin(7.0 * p.x() + 6.0 * p.y()));
    return p + (0.08 / n_) * wave - Eigen::Vector3d(1.0, 1.0, 0.0);
  }

  void addPiece(const Eigen::Vector3i& place, std::mt19937_64& random) {
    Piece piece;
    std::vector<Eigen::Vector3i> triangles;
    std::map<int, int> numbered;  // lattice points of the surface
    const auto vertex = [&](const Eigen::Vector3i& at) {
      const int key = (at.x() * (cells_ + 1) + at.y()) * (cells_ + 1) + at.z();
      const auto [found, isNew] = numbered.try_emplace(key, static_cast<int>(piece.shape.size()));
      if (isNew) piece.shape.push_back(placed(place, at.cast<double>() / cells_));
      return found->second;
    };
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {0, cells_}) {
        for (int u = 0; u < cells_; ++u) {
          for (int v = 0; v < cells_; ++v) {
            const auto corner = [&](int i, int j) {
              Eigen::Vector3i at;
              at[axis] = side;
              at[(axis + 1) % 3] = u + i;
              at[(axis + 2) % 3] = v + j;
              return vertex(at);
            };
            triangles.emplace_back(corner(0, 0), corner(1, 0), corner(1, 1));
            triangles.emplace_back(corner(0, 0), corner(1, 1), corner(0, 1));
          }
        }
      }
    }
    piece.middle.setZero();
    for (const Eigen::Vector3d& p : piece.shape)
      piece.middle += p / static_cast<double>(piece.shape.size());
    for (Eigen::Vector3d& p : piece.shape) p = 0.985 * (p - piece.middle);
    piece.velocity =
        0.5 * (piece.middle - Eigen::Vector3d(0.1, -0.05, 0.2)) + 0.06 * direction(random);
    piece.spin = uniform(random, 0.15, 1.5) * direction(random);
    piece.bend = uniform(random, 0.05, 0.25);
    pieces_.push_back(std::move(piece));
    objects_.push_back(std::move(triangles));
  }

  int n_, cells_;
  Points jitter_;  ///< m, of the pieces' corners
  std::vector<Piece> pieces_;
};

}  // namespace swept::benchmark
