// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// What a path file says, in arithmetic of 50 digits: it is read and worked out here once more,
/// with nothing of the checker of proofs. Numbers are the doubles that the file has, axes have the
/// length 1, and matrices are as given.
namespace forgeries {

using Json = nlohmann::ordered_json;
using Real =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                  boost::multiprecision::expression_template_option::et_off>;

/// The square root of a number that is 0 or more.
Real root(const Real& square);

struct Vec {
  Real x, y, z;
  Vec operator+(const Vec& o) const { return {x + o.x, y + o.y, z + o.z}; }
  Vec operator-(const Vec& o) const { return {x - o.x, y - o.y, z - o.z}; }
  Vec operator*(const Real& s) const { return {x * s, y * s, z * s}; }
  Real dot(const Vec& o) const { return x * o.x + y * o.y + z * o.z; }
  Vec cross(const Vec& o) const {
    return {y * o.z - z * o.y, z * o.x - x * o.z, x * o.y - y * o.x};
  }
  Real norm() const { return root(dot(*this)); }
};
Vec vecOf(const Json& numbers);

/// x -> linear x + translation; `columns` of the linear part.
struct Pose {
  std::array<Vec, 3> columns{Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}};
  Vec translation{0, 0, 0};
  Vec turned(const Vec& v) const { return columns[0] * v.x + columns[1] * v.y + columns[2] * v.z; }
  /// The transposed linear part times v.
  Vec back(const Vec& v) const { return {columns[0].dot(v), columns[1].dot(v), columns[2].dot(v)}; }
  Vec operator*(const Vec& v) const { return turned(v) + translation; }
  Pose operator*(const Pose& o) const;
};
Pose poseOf(const Json& numbers);

/// A convex set, in the frame of its body.
struct Solid {
  Pose frame;
  std::string type;
  std::vector<Vec> points = {};     ///< of hulls, triangles and balls, in the shape's frame
  Real radius = 0, halfLength = 0;  ///< m
  Vec extents = {0, 0, 0};          ///< m, of boxes and ellipsoids
  /// max over the set of direction . x.
  Real support(const Vec& direction) const;
};

/// normal . x = offset, or <= offset; the normal has any length.
struct Wall {
  Vec normal;
  Real offset;
  bool isSolid = false;  ///< the latter
};

/// Triangles of a solid mesh, in the frame of its body.
using Shell = std::vector<std::array<Vec, 3>>;

struct ExactBody {
  std::string link;  ///< empty: the world
  std::vector<Solid> solids;
  std::vector<Wall> walls;
  std::vector<Shell> shells;
};
ExactBody bodyOf(const Json& body);

/// How far joints are off, within what `tracking` of a model allows.
struct Errors {
  std::map<std::size_t, Real> values;    ///< rad or m, by variable, of joints with one value
  std::map<std::string, Vec> slides;     ///< m, by planar or floating joint, in its frame
  std::map<std::string, Vec> axes;       ///< of a floating joint's error
  std::map<std::string, Real> rotation;  ///< rad, of a planar or floating joint's
};

/// Where links are at t in [0, 1] of a segment: on the way from one state to the next, or from one
/// point of a trajectory to the next.
class ExactMotion {
 public:
  ExactMotion(const Json& path, std::size_t segment);

  /// The link's frame in that of a link above, or the model's ("").
  Pose placed(const std::string& link, const std::string& reference, const Real& t,
              const Errors& errors) const;
  /// The link nearest to both that is above, or is, each; "": the model frame.
  std::string commonAncestor(const std::string& a, const std::string& b) const;
  /// A value of the configuration.
  Real valueOf(std::size_t variable, const Real& t) const;

 private:
  const Json* jointAbove(const std::string& link) const;
  Pose moved(const Json& joint, const Real& t, const Errors& errors) const;

  const Json& model_;
  const Json& from_;  ///< values
  const Json& to_;
  const Json* begin_ = nullptr;  ///< point of a trajectory; null: none
  const Json* end_ = nullptr;
};

/// Whether a point is in what closed triangles enclose, by a ray that crosses none of their edges.
bool isInside(const Shell& shell, const Vec& point);

}  // namespace forgeries
