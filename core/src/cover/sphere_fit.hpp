// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <deque>
#include <map>
#include <random>
#include <span>
#include <vector>

#include "cover/posed_body.hpp"
#include "swept/core/enclosing_spheres.hpp"

namespace swept::detail {

/// Spheres around a body while they are searched for. Each piece is owned by one of them.
class SphereFit {
 public:
  SphereFit(std::span<const PosedShape> body, const EnclosingSpheresOptions& options,
            const StopQuestion& stop);

  /// Of the greedy choice.
  int countFor(double reach) const;
  EnclosingSpheres atMost(int count, const StopQuestion& stop);
  EnclosingSpheres within(double reach, const StopQuestion& stop);

 private:
  struct Place {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< m
    double depth = 0.0;  ///< m, of the body around it, with pockets filled
  };
  struct Ball {
    Place place = {};
    double radius = 0.0;                        ///< m
    std::vector<const BodyPiece*> pieces = {};  ///< in it
    /// Those that it was last put in the best place for: most balls keep theirs.
    std::vector<const BodyPiece*> centeredFor = {};
    double reach() const { return radius - place.depth; }  ///< m, beyond the body
  };
  using Balls = std::vector<Ball>;

  void divide(int pieces, double largest);
  void findPlaces();
  void addPlace(const Place& place);
  Balls greedy(double reach, double noise, std::mt19937& random) const;
  double reachFor(int count, double noise, std::mt19937& random) const;

  Place placeAt(const Eigen::Vector3d& center) const { return {center, body_.depth(center, true)}; }
  void measure(Ball& ball) const;
  Balls owned(const Balls& places) const;
  void recenter(Ball& ball) const;
  Balls settled(const Balls& places, int steps) const;
  Balls searched(int count) const;
  void fill(Balls& balls, int count) const;
  Balls changed(Balls balls, int count) const;
  void improve(Balls& balls, int rounds, std::mt19937& random) const;
  Place placeFor(const Ball& ball) const;
  /// The ball that the others can replace best, and the reach that they then need.
  std::pair<std::size_t, double> leastUseful(const Balls& balls) const;
  void shrink(Ball& ball, Balls& balls, std::deque<BodyPiece>& divided);
  EnclosingSpheres finished(Balls balls);

  EnclosingSpheresOptions options_;
  StopQuestion stop_;  ///< of the present call
  PosedBody body_;
  double size_ = 0.0;  ///< m
  std::vector<BodyPiece> pieces_;
  std::vector<Place> places_;
  struct Found {
    Balls balls;             ///< their pieces not yet divided
    bool isChanged = false;  ///< made of the balls of a number nearby, not searched from nothing
  };
  std::map<int, Found> found_;             ///< by the number that was asked for
  std::vector<std::vector<float>> needs_;  ///< m, per place and piece: the reach of a ball for it
};

}  // namespace swept::detail
