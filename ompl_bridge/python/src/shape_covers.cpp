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
#include "enums.hpp"
#include "spheres.hpp"
#include "swept/core/enclosing_shapes.hpp"
#include "watch.hpp"

namespace py = pybind11;

namespace swept::python {
namespace {

/// swept.EnclosingShapesSearch.
class ShapeSearchHandle {
 public:
  ShapeSearchHandle(const std::vector<PosedShape>& body, EnclosingKind kind,
                    const EnclosingShapesOptions& options, const StopQuestion& stop)
      : search_(body, kind, options, stop) {}
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
  EnclosingShapesSearch search_;
};

void bindFound(py::module_& module) {
  py::class_<EnclosingShapes> type(module, "EnclosingShapes",
                                   "Shapes that together contain a body: proven.");
  type.def_property_readonly(
          "shapes", [](const EnclosingShapes& self) { return listOf(self.shapes); },
          "A list of pairs of a Shape and its pose (4, 4) in the body's frame: capsules, boxes, or "
          "convex hulls, whose pose is the identity.")
      .def_readonly("reach", &EnclosingShapes::reach,
                    "m: no sampled point of a shape's surface is farther from the body. "
                    "shapes_excess proves more.")
      .def("__len__", [](const EnclosingShapes& self) { return self.shapes.size(); })
      .def("__repr__", [](const EnclosingShapes& self) {
        return "<swept.EnclosingShapes, " + std::to_string(self.shapes.size()) + ", reach " +
               std::string(py::str(py::float_(self.reach))) + " m>";
      });
  addImmutableCopies(type);
}

void bindSearch(py::module_& module) {
  using Search = EnclosingShapesSearch;
  const EnclosingShapesOptions usual;
  py::class_<ShapeSearchHandle>(
      module, "EnclosingShapesSearch",
      "Searches for few capsules, boxes or convex hulls that contain a body: as a solid where its "
      "meshes are closed. Each result is proven, rounding\nincluded. If several threads use it, "
      "one works and the others wait.")
      .def(
          py::init(
              [](const py::object& shape, const py::object& kind, int pieces, const Token& cancel) {
                const std::vector<PosedShape> body = posedOf(shape);
                const EnclosingKind of = enclosingKindOf(kind, "kind");
                return watched(cancel, [&](const std::stop_token& stop) {
                  return std::make_unique<ShapeSearchHandle>(
                      body, of, EnclosingShapesOptions{pieces}, questionOf(stop));
                });
              }),
          py::arg("shape"), py::arg("kind"), py::kw_only(), py::arg("pieces") = usual.pieces,
          py::arg("cancel") = py::none(),
          "`shape`: a Shape, or a list of pairs of a Shape and its pose; Robot.link_shapes has "
          "those of a link. `kind`: EnclosingKind. `pieces`: that the\nbody is divided into before "
          "they are joined. Raises ArgumentError for a body without shapes, planes and "
          "half-spaces, and less than one piece. `cancel` and Ctrl-C are as in "
          "EnclosingSpheresSearch.")
      .def(
          "count_for",
          [](ShapeSearchHandle& self, double reach) {
            return self.ask([&](Search& search) { return search.countFor(reach); });
          },
          py::arg("reach"),
          "How many shapes are needed so that none reaches farther than this (m) beyond the body, "
          "by samples of their surface.")
      .def(
          "reach_for",
          [](ShapeSearchHandle& self, int count) {
            return self.ask([&](Search& search) { return search.reachFor(count); });
          },
          py::arg("count"),
          "m: how far at most so many shapes reach, before shared pieces are divided. Raises "
          "ArgumentError for less than one.")
      .def(
          "at_most",
          [](ShapeSearchHandle& self, int count, const Token& cancel) {
            return self.askWatched(cancel, [&](Search& search, const std::stop_token& stop) {
              return search.atMost(count, questionOf(stop));
            });
          },
          py::arg("count"), py::kw_only(), py::arg("cancel") = py::none(),
          "EnclosingShapes: at most so many, with a small reach. Raises ArgumentError for less "
          "than one.")
      .def(
          "within",
          [](ShapeSearchHandle& self, double reach, const Token& cancel) {
            return self.askWatched(cancel, [&](Search& search, const std::stop_token& stop) {
              return search.within(reach, questionOf(stop));
            });
          },
          py::arg("reach"), py::kw_only(), py::arg("cancel") = py::none(),
          "EnclosingShapes: few that reach at most this (m) beyond the body, proven by "
          "shapes_excess, if the pieces are small enough for it. Raises\nArgumentError unless it "
          "is above 0.");
}

}  // namespace

void bindShapeCovers(py::module_& module) {
  bindFound(module);
  bindSearch(module);
  const OutsideSpheresOptions judged;
  module.def(
      "outside_shapes",
      [](const py::object& shape, const py::object& shapes, double tolerance, int mostSplits,
         int samples, const Token& cancel) {
        const std::vector<PosedShape> body = posedOf(shape), all = posedOf(shapes);
        return watched(cancel, [&](const std::stop_token& stop) {
          return outsideShapes(body, all, {tolerance, mostSplits, samples, questionOf(stop)});
        });
      },
      py::arg("shape"), py::arg("shapes"), py::kw_only(), py::arg("tolerance") = judged.tolerance,
      py::arg("most_splits") = judged.mostSplits, py::arg("samples") = judged.samples,
      py::arg("cancel") = py::none(),
      "OutsideSpheres of a body and `shapes` in place of spheres: spheres, boxes, capsules, "
      "cylinders, convex hulls, and meshes that are star-shaped\nabout the mean of their vertices. "
      "How far a point is outside a hull or a mesh is the largest distance that it is in front of "
      "a "
      "face. Both\nbodies and the other arguments are as in outside_spheres. Raises ArgumentError "
      "as that does, and for shapes of other types.");
  const SphereExcessOptions measured;
  module.def(
      "shapes_excess",
      [](const py::object& shape, const py::object& shapes, double growth, int samples,
         double tolerance, int mostDistances, std::uint32_t seed, const Token& cancel) {
        const std::vector<PosedShape> body = posedOf(shape), all = posedOf(shapes);
        return watched(cancel, [&](const std::stop_token& stop) {
          return shapesExcess(body, all, growth,
                              {samples, tolerance, mostDistances, seed, questionOf(stop)});
        });
      },
      py::arg("shape"), py::arg("shapes"), py::arg("growth") = 0.0, py::kw_only(),
      py::arg("samples") = measured.samples, py::arg("tolerance") = measured.tolerance,
      py::arg("most_distances") = measured.mostDistances, py::arg("seed") = measured.seed,
      py::arg("cancel") = py::none(),
      "SphereExcess of shapes as outside_shapes has them, each grown by `growth` (m). The other "
      "arguments are those of sphere_excess.");
}

}  // namespace swept::python
