// SPDX-License-Identifier: BSD-3-Clause
#include "shapes.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "arrays.hpp"
#include "binding.hpp"
#include "errors.hpp"
#include "loading.hpp"
#include "swept/robot_model/cloud_file.hpp"
#include "swept/robot_model/mesh_file.hpp"

namespace py = pybind11;

namespace swept::python {
namespace {

const char* kindOf(const Shape& shape) {
  constexpr std::array kNames{"sphere", "box",      "cylinder", "capsule",    "cone", "ellipsoid",
                              "convex", "triangle", "plane",    "half_space", "mesh", "cloud"};
  static_assert(std::variant_size_v<Shape> == kNames.size());
  return kNames[shape.index()];
}

/// The arguments of the function that makes a shape of this type.
struct Parameters {
  py::dict operator()(const Sphere& shape) const { return with("radius", shape.radius); }
  py::dict operator()(const Box& shape) const {
    return with("size", makeArray(Eigen::Vector3d(2.0 * shape.halfExtents)));
  }
  py::dict operator()(const Ellipsoid& shape) const {
    return with("semi_axes", makeArray(shape.semiAxes));
  }
  py::dict operator()(const ConvexHull& shape) const {
    return with("points", makeArray(shape.vertices()));
  }
  py::dict operator()(const Triangle& shape) const {
    return with("corners", makeArray(std::span<const Eigen::Vector3d>(shape.corners)));
  }
  py::dict operator()(const TriangleMesh& shape) const {
    std::vector<std::uint32_t> corners;
    for (const TriangleMesh::Triangle& triangle : shape.triangles())
      for (const int corner : triangle) corners.push_back(static_cast<std::uint32_t>(corner));
    py::dict all = with("vertices", makeArray(shape.vertices()));
    all["triangles"] = makeIndices(corners, 3);
    all["solid"] = shape.interior() == MeshInterior::Solid;
    return all;
  }
  py::dict operator()(const PointCloud& shape) const {
    std::vector<double> radii;
    for (std::size_t i = 0; i < shape.points().size(); ++i) radii.push_back(shape.radius(i));
    py::dict all = with("points", makeArray(shape.points()));
    all["radius"] = makeArray(radii);
    return all;
  }
  /// Cylinders, capsules and cones; planes and half-spaces.
  template <typename Other>
  py::dict operator()(const Other& shape) const {
    if constexpr (requires { shape.normal; }) {
      py::dict all = with("normal", makeArray(shape.normal));
      all["offset"] = shape.offset;
      return all;
    } else {
      py::dict all = with("radius", shape.radius);
      all["length"] = 2.0 * shape.halfLength;
      return all;
    }
  }

 private:
  static py::dict with(const char* name, const py::object& value) {
    py::dict all;
    all[name] = value;
    return all;
  }
  static py::dict with(const char* name, double value) { return with(name, py::float_(value)); }
};

ShapeHandle mesh(const py::object& vertices, const py::object& triangles, bool solid) {
  const std::vector<Eigen::Vector3d> points = readTable(vertices, "vertices", 3).points();
  const std::vector<Eigen::Vector3i> corners = readTriangles(triangles, "triangles", points.size());
  const py::gil_scoped_release others;
  return {
      TriangleMesh::build(points, corners, solid ? MeshInterior::Solid : MeshInterior::Surface)};
}

ShapeHandle moved(const ShapeHandle& self, const py::object& vertices) {
  const auto* mesh = std::get_if<TriangleMesh>(&self.shape);
  if (mesh == nullptr)
    throw std::invalid_argument(std::string("moved: expected a mesh, got a ") + kindOf(self.shape));
  const std::vector<Eigen::Vector3d> points = readTable(vertices, "vertices", 3).points();
  const py::gil_scoped_release others;
  return {mesh->moved(points)};
}

ShapeHandle convex(const py::object& points) {
  const std::vector<Eigen::Vector3d> corners = readTable(points, "points", 3).points();
  const py::gil_scoped_release others;
  return {ConvexHull::of(corners)};
}

ShapeHandle cloud(const py::object& points, const py::object& radius) {
  const std::vector<Eigen::Vector3d> centres = readTable(points, "points", 3).points();
  if (PyFloat_Check(radius.ptr()) || PyLong_Check(radius.ptr())) {
    const double all = radius.cast<double>();
    const py::gil_scoped_release others;
    return {PointCloud::build(centres, all)};
  }
  const Table radii = readVector(radius, "radius", centres.size());
  const py::gil_scoped_release others;
  return {PointCloud::build(centres, radii.numbers())};
}

ShapeHandle loadMeshFile(const std::filesystem::path& file, const py::object& scale) {
  Remarks remarks;
  const LoadOptions options = remarks.optionsFor({});
  const Eigen::Vector3d factors = PyFloat_Check(scale.ptr()) || PyLong_Check(scale.ptr())
                                      ? Eigen::Vector3d::Constant(scale.cast<double>())
                                      : readPoint(scale, "scale");
  ShapeHandle shape{Sphere{}};
  {
    const py::gil_scoped_release others;
    shape.shape = loadMesh(file, factors, options);
  }
  remarks.warn();
  return shape;
}

py::object loadPointFile(const std::filesystem::path& file) {
  Remarks remarks;
  const LoadOptions options = remarks.optionsFor({});
  std::vector<Eigen::Vector3d> points;
  {
    const py::gil_scoped_release others;
    points = loadPoints(file, options);
  }
  remarks.warn();
  return makeArray(points);
}

/// A Sphere and so on from numbers.
template <auto kMake>
ShapeHandle makeRound(double radius, double length) {
  return {kMake(radius, length)};
}

}  // namespace

std::vector<std::pair<Shape, Eigen::Isometry3d>> piecesOf(const py::object& shape,
                                                          const py::object& pose) {
  const Eigen::Isometry3d frame = readPose(pose, "pose");
  if (py::isinstance<ShapeHandle>(shape)) return {{shape.cast<ShapeHandle&>().shape, frame}};
  const auto refuse = [&] {
    throw ArgumentTypeError(
        "shape: expected a swept.Shape, or a list of pairs of a swept.Shape and its pose (4, 4); "
        "got " +
        std::string(py::repr(shape)));
  };
  if (!py::isinstance<py::sequence>(shape)) refuse();
  std::vector<std::pair<Shape, Eigen::Isometry3d>> pieces;
  for (const py::handle item : shape) {
    if (!py::isinstance<py::sequence>(item) || py::len(item) != 2) refuse();
    const auto pair = py::reinterpret_borrow<py::sequence>(item);
    if (!py::isinstance<ShapeHandle>(py::object(pair[0]))) refuse();
    pieces.emplace_back(py::object(pair[0]).cast<ShapeHandle&>().shape,
                        frame * readPose(py::object(pair[1]), "pose"));
  }
  return pieces;
}

void bindShapes(py::module_& module) {
  py::class_<ShapeHandle> shape(
      module, "Shape",
      "A closed set in its own frame, centred at the origin if that makes sense; solid, except for "
      "triangles, planes and\nopen meshes. Lengths are full lengths in m. Immutable. Each function "
      "raises ArgumentError, naming the value, for a\nsize that is negative or not finite.");
  shape
      .def_static(
          "sphere", [](double radius) { return ShapeHandle{makeSphere(radius)}; },
          py::arg("radius"), "A ball.")
      .def_static(
          "box",
          [](const py::object& size) { return ShapeHandle{makeBox(readPoint(size, "size"))}; },
          py::arg("size"), "`size`: (3,), full lengths along x, y and z.")
      .def_static("cylinder", &makeRound<&makeCylinder>, py::arg("radius"), py::arg("length"),
                  "Flat ends, the axis along z.")
      .def_static("capsule", &makeRound<&makeCapsule>, py::arg("radius"), py::arg("length"),
                  "`length`: along z, between the centres of the caps.")
      .def_static("cone", &makeRound<&makeCone>, py::arg("radius"), py::arg("length"),
                  "The apex at +length / 2 on z, the base at -length / 2.")
      .def_static(
          "ellipsoid",
          [](const py::object& semiAxes) {
            return ShapeHandle{makeEllipsoid(readPoint(semiAxes, "semi_axes"))};
          },
          py::arg("semi_axes"), "`semi_axes`: (3,), along x, y and z.")
      .def_static(
          "plane",
          [](const py::object& normal, double offset) {
            return ShapeHandle{makePlane(readPoint(normal, "normal"), offset)};
          },
          py::arg("normal"), py::arg("offset") = 0.0,
          "The points x with normal . x = offset. `normal`: (3,), of any length.")
      .def_static(
          "half_space",
          [](const py::object& normal, double offset) {
            return ShapeHandle{makeHalfSpace(readPoint(normal, "normal"), offset)};
          },
          py::arg("normal"), py::arg("offset") = 0.0,
          "The points x with normal . x <= offset. `normal`: (3,), points out of the solid.")
      .def_static("convex", &convex, py::arg("points"), "The convex hull of points (n, 3).")
      .def_static(
          "mesh", &mesh, py::arg("vertices"), py::arg("triangles"), py::kw_only(),
          py::arg("solid") = true,
          "Triangles (m, 3), any integers, over vertices (n, 3). `solid`: what a closed part "
          "encloses belongs to it.\nCracks that rounding leaves are closed, as in C++.")
      .def_static("cloud", &cloud, py::arg("points"), py::arg("radius"),
                  "A solid ball around each of points (n, 3). `radius`: one, or (n,).")
      .def_static("load_mesh", &loadMeshFile, py::arg("file"), py::arg("scale") = 1.0,
                  "The mesh in an STL, OBJ, PLY, COLLADA, OFF or glTF file. `scale`: a factor, or "
                  "one for each axis (3,).\nRaises InputError.")
      .def(
          "scaled",
          [](const ShapeHandle& self, double factor) {
            return ShapeHandle{scaled(self.shape, factor)};
          },
          py::arg("factor"), "Scaled in all directions about the centre of its box.")
      .def("moved", &moved, py::arg("vertices"),
           "The next frame of a mesh that deforms: the same triangles over other vertices (n, 3), "
           "in the order of `mesh`.")
      .def_property_readonly(
          "kind", [](const ShapeHandle& self) { return kindOf(self.shape); },
          "`sphere`, `box`, ..., the name of the function that makes it.")
      .def_property_readonly(
          "parameters",
          [](const ShapeHandle& self) { return std::visit(Parameters(), self.shape); },
          "The arguments of the function that makes it, by name, as arrays and numbers: "
          "`getattr(Shape, kind)(**parameters)` is the same shape. Points of\na hull are its "
          "corners; those of meshes and clouds are in an order of their own. Of a `triangle` of a "
          "file: `corners` (3, 3).")
      .def("__repr__", [](const ShapeHandle& self) {
        return std::string("<swept.Shape ") + kindOf(self.shape) + ">";
      });
  addImmutableCopies(shape);
  module.def("load_points", &loadPointFile, py::arg("file"),
             "Points (n, 3), m, of a sensed cloud: a PCD, PLY or XYZ file. Raises InputError.");
}

}  // namespace swept::python
