// SPDX-License-Identifier: BSD-3-Clause
#include "sphere_refuter.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <optional>
#include <random>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace swept::test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Corners = std::array<Vector3d, 3>;
using Element = tinyxml2::XMLElement;

Vector3d numbers(const char* text, const Vector3d& otherwise) {
  if (text == nullptr) return otherwise;
  std::istringstream in(text);
  Vector3d out;
  if (!(in >> out.x() >> out.y() >> out.z())) throw std::runtime_error(text);
  return out;
}

Isometry3d originOf(const Element& element) {
  Isometry3d pose = Isometry3d::Identity();
  const Element* origin = element.FirstChildElement("origin");
  if (origin == nullptr) return pose;
  const Vector3d rpy = numbers(origin->Attribute("rpy"), Vector3d::Zero());
  pose.linear() = (Eigen::AngleAxisd(rpy.z(), Vector3d::UnitZ()) *
                   Eigen::AngleAxisd(rpy.y(), Vector3d::UnitY()) *
                   Eigen::AngleAxisd(rpy.x(), Vector3d::UnitX()))
                      .toRotationMatrix();
  pose.translation() = numbers(origin->Attribute("xyz"), Vector3d::Zero());
  return pose;
}

std::vector<Corners> objTriangles(std::istream& in) {
  std::vector<Vector3d> vertices;
  std::vector<Corners> triangles;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v") {
      Vector3d v;
      words >> v.x() >> v.y() >> v.z();
      vertices.push_back(v);
    } else if (kind == "f") {
      std::vector<Vector3d> face;
      for (std::string word; words >> word;) {
        const long index = std::stol(word);
        face.push_back(vertices.at(static_cast<std::size_t>(
            index > 0 ? index - 1 : static_cast<long>(vertices.size()) + index)));
      }
      for (std::size_t i = 2; i < face.size(); ++i)
        triangles.push_back({face[0], face[i - 1], face[i]});
    }
  }
  return triangles;
}

std::vector<Corners> stlTriangles(std::istream& in) {
  std::array<char, 80> header{};
  in.read(header.data(), header.size());
  std::uint32_t count = 0;
  in.read(reinterpret_cast<char*>(&count), 4);
  std::vector<Corners> triangles;
  for (std::uint32_t i = 0; i < count; ++i) {
    std::array<char, 50> record{};
    if (!in.read(record.data(), record.size())) throw std::runtime_error("an STL file ends early");
    std::array<float, 12> values{};
    std::memcpy(values.data(), record.data(), 48);
    Corners corners;
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = Vector3d(values[3 * k + 3], values[3 * k + 4], values[3 * k + 5]);
    triangles.push_back(corners);
  }
  return triangles;
}

std::vector<Corners> meshTriangles(const Element& mesh, const std::filesystem::path& folder) {
  std::string name = mesh.Attribute("filename");
  if (const std::string start = "package://"; name.starts_with(start))
    name = name.substr(start.size());
  std::ifstream in(folder / name, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + name);
  std::string ending = std::filesystem::path(name).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending != ".obj" && ending != ".stl") throw std::runtime_error("cannot read " + name);
  std::vector<Corners> triangles = ending == ".obj" ? objTriangles(in) : stlTriangles(in);
  const Vector3d scale = numbers(mesh.Attribute("scale"), Vector3d::Ones());
  for (Corners& corners : triangles)
    for (Vector3d& corner : corners) corner = corner.cwiseProduct(scale);
  return triangles;
}

std::vector<Corners> boxTriangles(const Vector3d& size) {
  std::vector<Corners> triangles;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-0.5, 0.5}) {
      std::array<Vector3d, 4> square;
      for (int i = 0; i < 4; ++i) {
        Vector3d p;
        p[axis] = side;
        p[(axis + 1) % 3] = i == 1 || i == 2 ? 0.5 : -0.5;
        p[(axis + 2) % 3] = i >= 2 ? 0.5 : -0.5;
        square[static_cast<std::size_t>(i)] = p.cwiseProduct(size);
      }
      if (side < 0.0) std::swap(square[1], square[3]);  // seen from outside, all turn alike
      triangles.push_back({square[0], square[1], square[2]});
      triangles.push_back({square[0], square[2], square[3]});
    }
  return triangles;
}

/// A polyhedron within a ball, or within a cylinder along z (`half`: m, of its length), with its
/// corners on the surface.
std::vector<Corners> roundTriangles(double radius, std::optional<double> half) {
  constexpr int kSides = 128;
  constexpr int kSteps = 32;
  std::vector<std::array<double, 2>> outline;  // across, along
  if (half)
    outline = {{0.0, -*half}, {radius, -*half}, {radius, *half}, {0.0, *half}};
  else
    for (int i = 0; i <= 2 * kSteps; ++i) {
      const double angle = 1.5707963267948966 * (i - kSteps) / kSteps;
      outline.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
  std::vector<Corners> triangles;
  for (int side = 0; side < kSides; ++side)
    for (std::size_t i = 1; i < outline.size(); ++i) {
      const auto point = [&](std::size_t at, int k) {
        const double angle = 6.283185307179586 * (k % kSides) / kSides;
        return Vector3d(outline[at][0] * std::cos(angle), outline[at][0] * std::sin(angle),
                        outline[at][1]);
      };
      triangles.push_back({point(i - 1, side), point(i - 1, side + 1), point(i, side + 1)});
      triangles.push_back({point(i - 1, side), point(i, side + 1), point(i, side)});
    }
  return triangles;
}

/// The first robot element of a file; `document` keeps it.
const Element& robotOf(const std::filesystem::path& file, tinyxml2::XMLDocument& document) {
  if (document.LoadFile(file.c_str()) != tinyxml2::XML_SUCCESS)
    throw std::runtime_error("cannot read " + file.string());
  return *document.RootElement();
}

double outside(const std::vector<RefuterBall>& balls, const Vector3d& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [center, radius] : balls) least = std::min(least, (p - center).norm() - radius);
  return least;
}

bool triangleIsIn(const Corners& corners, const std::vector<RefuterBall>& balls, double error,
                  int depth) {
  for (const auto& [center, radius] : balls)
    if (std::ranges::all_of(corners, [&, c = center, r = radius](const Vector3d& p) {
          return (p - c).norm() <= r + error;
        }))
      return true;
  if (depth == 0) return false;
  std::size_t longest = 0;
  const auto length = [&](std::size_t i) { return (corners[i] - corners[(i + 1) % 3]).norm(); };
  for (std::size_t i = 1; i < 3; ++i)
    if (length(i) > length(longest)) longest = i;
  const Vector3d middle = 0.5 * (corners[longest] + corners[(longest + 1) % 3]);
  if (outside(balls, middle) > error) return false;
  Corners first = corners;
  Corners second = corners;
  first[longest] = middle;
  second[(longest + 1) % 3] = middle;
  return triangleIsIn(first, balls, error, depth - 1) &&
         triangleIsIn(second, balls, error, depth - 1);
}

/// Where three spheres meet: none, or two points.
std::vector<Vector3d> meetings(const RefuterBall& a, const RefuterBall& b, const RefuterBall& c) {
  const Vector3d ab = b.center - a.center;
  const double d = ab.norm();
  if (!(d > 0.0)) return {};
  const Vector3d ex = ab / d;
  const Vector3d ac = c.center - a.center;
  const double i = ex.dot(ac);
  const Vector3d across = ac - i * ex;
  const double j = across.norm();
  if (!(j > 1e-12)) return {};
  const Vector3d ey = across / j;
  const double x = (a.radius * a.radius - b.radius * b.radius + d * d) / (2.0 * d);
  const double y =
      (a.radius * a.radius - c.radius * c.radius + i * i + j * j) / (2.0 * j) - i / j * x;
  const double squared = a.radius * a.radius - x * x - y * y;
  if (squared < 0.0) return {};
  const Vector3d foot = a.center + x * ex + y * ey;
  const Vector3d up = std::sqrt(squared) * ex.cross(ey);
  return {foot + up, foot - up};
}

/// By the angles that the triangles are seen under (Van Oosterom, Strackee 1983): about 1 inside a
/// closed surface, 0 outside.
double turnsAround(const std::vector<Corners>& triangles, const Vector3d& p) {
  double sum = 0.0;
  for (const Corners& corners : triangles) {
    const Vector3d a = corners[0] - p;
    const Vector3d b = corners[1] - p;
    const Vector3d c = corners[2] - p;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    sum += 2.0 * std::atan2(a.dot(b.cross(c)),
                            la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return std::abs(sum) / (4.0 * 3.14159265358979);
}

}  // namespace

std::map<std::string, RefuterLink> readRefuterLinks(const std::filesystem::path& urdf,
                                                    const std::filesystem::path& spheres) {
  std::map<std::string, RefuterLink> links;
  tinyxml2::XMLDocument first;
  const Element& robot = robotOf(urdf, first);
  for (const auto* link = robot.FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link")) {
    RefuterLink& own = links[link->Attribute("name")];
    for (const auto* collision = link->FirstChildElement("collision"); collision != nullptr;
         collision = collision->NextSiblingElement("collision")) {
      const Element* geometry = collision->FirstChildElement("geometry");
      std::vector<Corners> triangles;
      if (const Element* mesh = geometry->FirstChildElement("mesh"))
        triangles = meshTriangles(*mesh, urdf.parent_path());
      else if (const Element* box = geometry->FirstChildElement("box"))
        triangles = boxTriangles(numbers(box->Attribute("size"), Vector3d::Zero()));
      else if (const Element* ball = geometry->FirstChildElement("sphere"))
        triangles = roundTriangles(ball->DoubleAttribute("radius"), {});
      else if (const Element* column = geometry->FirstChildElement("cylinder"))
        triangles = roundTriangles(column->DoubleAttribute("radius"),
                                   0.5 * column->DoubleAttribute("length"));
      const Isometry3d pose = originOf(*collision);
      for (Corners& corners : triangles)
        for (Vector3d& corner : corners) corner = pose * corner;
      own.triangles.insert(own.triangles.end(), triangles.begin(), triangles.end());
      own.shapes.push_back(std::move(triangles));
    }
  }
  tinyxml2::XMLDocument second;
  const Element& balls = robotOf(spheres, second);
  for (const auto* link = balls.FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link"))
    for (const auto* collision = link->FirstChildElement("collision"); collision != nullptr;
         collision = collision->NextSiblingElement("collision")) {
      const Element* sphere = collision->FirstChildElement("geometry")->FirstChildElement("sphere");
      if (sphere == nullptr) throw std::runtime_error("a collision element is no sphere");
      links[link->Attribute("name")].balls.push_back(
          {originOf(*collision).translation(), sphere->DoubleAttribute("radius")});
    }
  return links;
}

double sampledOutside(const RefuterLink& link, std::uint64_t points, std::uint32_t seed) {
  double most = -std::numeric_limits<double>::infinity();
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform;
  double area = 0.0;
  const auto areaOf = [](const Corners& t) { return (t[1] - t[0]).cross(t[2] - t[0]).norm(); };
  for (const Corners& corners : link.triangles) area += areaOf(corners);
  const auto share = static_cast<double>(points);
  const double perTriangle = share / 2.0 / static_cast<double>(link.triangles.size());
  for (const Corners& t : link.triangles) {
    for (const Vector3d& corner : t) most = std::max(most, outside(link.balls, corner));
    const auto inner = static_cast<std::uint64_t>(share / 2.0 * areaOf(t) / area);
    const auto onEdges = static_cast<std::uint64_t>(perTriangle);
    for (std::uint64_t i = 0; i < inner + onEdges; ++i) {
      const double u = std::sqrt(uniform(random));
      const double v = i < inner ? uniform(random) : std::round(uniform(random));
      const Vector3d p = (1.0 - u) * t[0] + u * (1.0 - v) * t[1] + u * v * t[2];
      most = std::max(most, outside(link.balls, p));
    }
  }
  return most;
}

bool surfaceIsContained(const RefuterLink& link, double error) {
  constexpr int kMostHalvings = 60;
  return std::ranges::all_of(link.triangles, [&](const Corners& corners) {
    return triangleIsIn(corners, link.balls, error, kMostHalvings);
  });
}

bool insideIsContained(const RefuterLink& link, double error) {
  const auto& balls = link.balls;
  for (std::size_t i = 0; i < balls.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k)
        for (const Vector3d& p : meetings(balls[i], balls[j], balls[k])) {
          if (outside(balls, p) < -error) continue;
          for (const std::vector<Corners>& shape : link.shapes)
            if (turnsAround(shape, p) > 0.5) return false;
        }
  return true;
}

}  // namespace swept::test
