// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "binding.hpp"
#include "shapes.hpp"
#include "spheres.hpp"
#include "watch.hpp"

namespace py = pybind11;

namespace swept::python {
namespace {

/// swept.EnclosingSpheresSearch.
class SearchHandle {
 public:
  SearchHandle(const std::vector<PosedShape>& body, const EnclosingSpheresOptions& options,
               const StopQuestion& stop)
      : search_(body, options, stop) {}
  /// question(search), without the GIL, one thread at a time.
  template <typename Question>
  auto ask(Question&& question) {
    const py::gil_scoped_release others;
    const std::lock_guard lock(mutex_);
    return question(search_);
  }
  /// The same for question(search, stop), which Ctrl-C and the token end.
  template <typename Question>
  auto askWatched(std::shared_ptr<const CancellationToken> token, Question&& question) {
    return watched(std::move(token), [&](const std::stop_token& stop) {
      const std::lock_guard lock(mutex_);
      return question(search_, stop);
    });
  }

 private:
  std::mutex mutex_;
  EnclosingSpheresSearch search_;
};

void bindOutside(py::module_& module) {
  py::class_<OutsideSpheres> outside(
      module, "OutsideSpheres",
      "How far a body reaches out of the union of some spheres: all radii have to grow by just "
      "this so that the spheres contain it.\nNegative: they could shrink. True if the spheres "
      "contain the body, proven.");
  outside
      .def_readonly("lower", &OutsideSpheres::lower,
                    "m; the body has a point at least this far outside. inf without spheres.")
      .def_readonly("upper", &OutsideSpheres::upper,
                    "m, proven; at most 0: the spheres contain the body.")
      .def_property_readonly(
          "point", [](const OutsideSpheres& self) { return makeArray(self.point); },
          "(3,) m, the body's frame: within rounding of the point farthest outside.")
      .def_readonly("surface_share", &OutsideSpheres::surfaceShare,
                    "From 0 to 1: sampled share of the surface that is in no sphere; it proves "
                    "nothing.")
      .def("__bool__", [](const OutsideSpheres& self) { return self.upper <= 0.0; });
  addRepr(outside, {"lower", "upper", "point", "surface_share"});
  addImmutableCopies(outside);

  py::class_<SphereExcess> excess(module, "SphereExcess",
                                  "How far the surface of a union of spheres is from the body "
                                  "within.");
  excess
      .def_readonly("largest", &SphereExcess::largest,
                    "m, proven: no point of the surface is farther from the body.")
      .def_readonly("largest_seen", &SphereExcess::largestSeen, "m, at some point of the surface.")
      .def_readonly("mean", &SphereExcess::mean, "m, over the surface, sampled.")
      .def_readonly("volume_ratio", &SphereExcess::volumeRatio,
                    "Volume of the union relative to that of the body, sampled; nan: the body has "
                    "no inside.");
  addRepr(excess, {"largest", "largest_seen", "mean", "volume_ratio"});
  addImmutableCopies(excess);

  const OutsideSpheresOptions usual;
  module.def(
      "outside_spheres",
      [](const py::object& shape, const py::object& spheres, double tolerance, int mostSplits,
         int samples, const Token& cancel) {
        const std::vector<PosedShape> body = posedOf(shape);
        const std::vector<EnclosingSphere> all = spheresOf(spheres, "spheres");
        return watched(cancel, [&](const std::stop_token& stop) {
          return outsideSpheres(body, all, {tolerance, mostSplits, samples, questionOf(stop)});
        });
      },
      py::arg("shape"), py::arg("spheres"), py::kw_only(), py::arg("tolerance") = usual.tolerance,
      py::arg("most_splits") = usual.mostSplits, py::arg("samples") = usual.samples,
      py::arg("cancel") = py::none(),
      "OutsideSpheres: judges spheres (k, 4) of any origin, x, y, z and radius (m) in the body's "
      "frame. `shape`: a Shape, or a list of pairs of\na Shape and its pose, see also "
      "Robot.link_shapes. `tolerance`: m, how closely the bounds must agree; `most_splits`: of "
      "pieces of the\nbody, then they stay as they are. `samples`: for `surface_share`. Raises "
      "ArgumentError for planes, half-spaces and a tolerance that\nis not above 0.");
  const SphereExcessOptions measured;
  module.def(
      "sphere_excess",
      [](const py::object& shape, const py::object& spheres, int samples, double tolerance,
         int mostDistances, std::uint32_t seed, const Token& cancel) {
        const std::vector<PosedShape> body = posedOf(shape);
        const std::vector<EnclosingSphere> all = spheresOf(spheres, "spheres");
        return watched(cancel, [&](const std::stop_token& stop) {
          return sphereExcess(body, all,
                              {samples, tolerance, mostDistances, seed, questionOf(stop)});
        });
      },
      py::arg("shape"), py::arg("spheres"), py::kw_only(), py::arg("samples") = measured.samples,
      py::arg("tolerance") = measured.tolerance, py::arg("most_distances") = measured.mostDistances,
      py::arg("seed") = measured.seed, py::arg("cancel") = py::none(),
      "SphereExcess of spheres (k, 4) around a body; arguments as outside_spheres. `samples`: of "
      "the surface, and as many of the volume.\n`tolerance`: of `largest`, relative; "
      "`most_distances`: then it stays as it is. Raises ArgumentError for a body without shapes, "
      "too.");
}

void bindFound(py::module_& module) {
  py::class_<EnclosingSpheres> type(module, "EnclosingSpheres",
                                    "Spheres that together contain a body: proven.");
  type.def_property_readonly(
          "spheres", [](const EnclosingSpheres& self) { return arrayOf(self.spheres); },
          "(k, 4): x, y, z and radius (m), body's frame; numbers of single precision.")
      .def_readonly("reach", &EnclosingSpheres::reach,
                    "m. No sphere reaches farther beyond the body: proven, except that pockets of "
                    "open meshes count as filled.")
      .def("__len__", [](const EnclosingSpheres& self) { return self.spheres.size(); })
      .def("__repr__", [](const EnclosingSpheres& self) {
        return "<swept.EnclosingSpheres, " + std::to_string(self.spheres.size()) + ", reach " +
               std::string(py::str(py::float_(self.reach))) + " m>";
      });
  addImmutableCopies(type);
}

}  // namespace

std::vector<EnclosingSphere> spheresOf(const py::object& value, const char* argument) {
  const Table table = readTable(value, argument, 4);
  std::vector<EnclosingSphere> spheres;
  for (const ConfigurationView row : table.list())
    spheres.push_back({{row[0], row[1], row[2]}, row[3]});
  return spheres;
}

py::object arrayOf(const std::vector<EnclosingSphere>& spheres) {
  std::vector<std::vector<double>> rows;
  for (const EnclosingSphere& sphere : spheres)
    rows.push_back({sphere.center.x(), sphere.center.y(), sphere.center.z(), sphere.radius});
  return makeArray(rows, 4);
}

std::vector<PosedShape> posedOf(const py::object& shape) {
  std::vector<PosedShape> body;
  for (auto& [piece, body_from_shape] : piecesOf(shape, py::none()))
    body.push_back({std::move(piece), body_from_shape});
  return body;
}

py::list listOf(const std::vector<PosedShape>& shapes) {
  py::list list;
  for (const PosedShape& posed : shapes)
    list.append(py::make_tuple(ShapeHandle{posed.shape}, makeArray(posed.body_from_shape)));
  return list;
}

void bindCovers(py::module_& module) {
  bindOutside(module);
  bindFound(module);
  const EnclosingSpheresOptions usual;
  py::class_<SearchHandle>(
      module, "EnclosingSpheresSearch",
      "Searches for few spheres that contain a body: as a solid where its meshes are closed. Each "
      "result is proven, rounding included.\nIf several threads use it, one works and the others "
      "wait.")
      .def(py::init([](const py::object& shape, int pieces, int restarts, int rounds,
                       std::uint32_t seed, const Token& cancel) {
             const std::vector<PosedShape> body = posedOf(shape);
             const EnclosingSpheresOptions options{pieces, restarts, rounds, seed};
             return watched(cancel, [&](const std::stop_token& stop) {
               return std::make_unique<SearchHandle>(body, options, questionOf(stop));
             });
           }),
           py::arg("shape"), py::kw_only(), py::arg("pieces") = usual.pieces,
           py::arg("restarts") = usual.restarts, py::arg("rounds") = usual.rounds,
           py::arg("seed") = usual.seed, py::arg("cancel") = py::none(),
           "`shape`: a Shape, or a list of pairs of a Shape and its pose; Robot.link_shapes has "
           "those of a link. `pieces`: that the body is divided\ninto. The same `seed` gives the "
           "same spheres. Raises ArgumentError for a body without shapes, planes and half-spaces, "
           "and values below 1\n(`rounds`: 0). Ctrl-C and `cancel` end it and each search: "
           "KeyboardInterrupt, "
           "Cancelled. Then the search is over: further calls raise swept.Error.")
      .def(
          "count_for",
          [](SearchHandle& self, double reach) {
            return self.ask([&](EnclosingSpheresSearch& search) { return search.countFor(reach); });
          },
          py::arg("reach"),
          "About how many spheres are needed so that none reaches farther than this (m) beyond "
          "the body.")
      .def(
          "at_most",
          [](SearchHandle& self, int count, const Token& cancel) {
            return self.askWatched(
                cancel, [&](EnclosingSpheresSearch& search, const std::stop_token& stop) {
                  return search.atMost(count, questionOf(stop));
                });
          },
          py::arg("count"), py::kw_only(), py::arg("cancel") = py::none(),
          "EnclosingSpheres: at most so many, with a small reach. Raises ArgumentError for less "
          "than one.")
      .def(
          "within",
          [](SearchHandle& self, double reach, const Token& cancel) {
            return self.askWatched(
                cancel, [&](EnclosingSpheresSearch& search, const std::stop_token& stop) {
                  return search.within(reach, questionOf(stop));
                });
          },
          py::arg("reach"), py::kw_only(), py::arg("cancel") = py::none(),
          "EnclosingSpheres: few that reach at most this (m) beyond the body, if the pieces are "
          "small enough for it. Raises ArgumentError\nunless it is above 0.");
}

}  // namespace swept::python
