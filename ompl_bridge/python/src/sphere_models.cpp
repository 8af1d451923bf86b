// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/sphere_model.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "binding.hpp"
#include "covered.hpp"
#include "errors.hpp"
#include "loading.hpp"
#include "spheres.hpp"
#include "swept/robot_model/shape_model.hpp"
#include "swept/robot_model/text_file.hpp"
#include "swept/robot_model/usage_error.hpp"
#include "watch.hpp"

namespace py = pybind11;

namespace swept::python {
namespace {

using Reports = std::vector<LinkSphereReport>;

SphereModel modelOf(const py::dict& links) {
  SphereModel model;
  for (const auto& [link, spheres] : links) {
    const auto name = valueOf<std::string>(link, "links", "names of links");
    model.links.push_back({name, spheresOf(py::reinterpret_borrow<py::object>(spheres),
                                           ("spheres of '" + name + "'").c_str())});
  }
  return model;
}

const LinkSpheres& linkOf(const SphereModel& model, const std::string& name) {
  if (const LinkSpheres* link = model.find(name)) return *link;
  throw std::invalid_argument("the model has no spheres for a link '" + name + "'");
}

SphereModel search(const py::object& robot, std::optional<int> spheres,
                   std::optional<double> excess, int pieces, int restarts, int rounds,
                   std::uint32_t seed, unsigned threads, const Token& cancel) {
  if (spheres.has_value() == excess.has_value())
    throw std::invalid_argument("expected one of spheres and excess");
  const Covered covered = coveredOf(robot);
  return watched(cancel, [&](const std::stop_token& stop) {
    const SphereModelOptions options{.spheres = spheres,
                                     .excess = excess,
                                     .search = {pieces, restarts, rounds, seed},
                                     .threads = threads,
                                     .stop = stop};
    return covered.world ? enclosingSphereModel(covered.bodies, options)
                         : enclosingSphereModel(*covered.handle.robot, options);
  });
}

SphereModel load(const std::filesystem::path& file, const py::object& robot) {
  const Covered covered = coveredOf(robot);
  if (covered.world) {
    if (std::optional<SphereModel> spheres = sphereModelOf(shapesOfFile(file, covered)))
      return *std::move(spheres);
    throw InputError(file.string(), 0, "has shapes that are no spheres; ShapeModel.load reads it");
  }
  Remarks remarks;
  const LoadOptions options = remarks.optionsFor(covered.source);
  SphereModel model;
  {
    const py::gil_scoped_release others;
    model = readSphereModel(file, *covered.handle.robot, options);
  }
  remarks.warn();
  return model;
}

Reports judge(const SphereModel& self, const py::object& robot, double tolerance, int mostSplits,
              int samples, unsigned threads, const Token& cancel) {
  const Covered covered = coveredOf(robot);
  return watched(cancel, [&](const std::stop_token& stop) {
    return judgeSphereModel(covered.bodies, self,
                            {tolerance, mostSplits, samples, questionOf(stop)}, threads);
  });
}

std::string textOf(const SphereModel& self, const std::filesystem::path& file,
                   const Covered& covered, const std::stop_token& stop) {
  if (covered.world) return sceneTextOf(shapeModelOf(self), file, covered, stop);
  const std::string& name = covered.name;
  const std::string ending = endingOf(file);
  if (ending == ".json")
    return sphereModelJson(self, name,
                           judgeSphereModel(covered.bodies, self, {.stop = questionOf(stop)}));
  if (ending == ".yaml" || ending == ".yml") return curoboSpheres(self, name);
  if (ending == ".xrdf") return xrdfSpheres(self);
  const Source& source = covered.source;
  if (ending == ".srdf") {
    const std::string srdf = source.srdf.empty() ? "" : readTextFile(source.srdf.string());
    return sphereApproximationSrdf(self, name, srdf, source.srdf.string());
  }
  if (ending != ".urdf")
    throw UsageError("'" + file.string() + "' ends in '" + ending +
                     "'; allowed: .urdf, .yaml, .yml (cuRobo), .xrdf (cuMotion), .srdf, .json");
  const std::string urdf = urdfOf(covered.handle).string();
  return spherizedUrdf(self, readTextFile(urdf), urdf);
}

void save(const SphereModel& self, const std::filesystem::path& file, const py::object& robot) {
  const Covered covered = coveredOf(robot);
  const std::string text = watched(
      nullptr, [&](const std::stop_token& stop) { return textOf(self, file, covered, stop); });
  const py::gil_scoped_release others;
  writeText(file, text);
}

void bindReport(py::module_& module) {
  using Report = LinkSphereReport;
  py::class_<Report> type(
      module, "LinkSphereReport",
      "What is to be said about one link of a sphere or shape model. True if its "
      "spheres or shapes contain the link, proven.");
  type.def_readonly("link", &Report::link, "Its name.")
      .def_readonly("spheres", &Report::spheres, "How many it has.")
      .def_readonly("outside", &Report::outside, "OutsideSpheres: what of the link is in none.")
      .def_readonly("excess", &Report::excess,
                    "SphereExcess of the spheres, grown by `outside.upper` if that is above 0.")
      .def("__bool__", [](const Report& self) { return self.outside.upper <= 0.0; });
  addRepr(type, {"link", "spheres", "outside", "excess"});
  addImmutableCopies(type);
}

}  // namespace

void bindSphereModels(py::module_& module) {
  bindReport(module);
  const EnclosingSpheresOptions usual;
  const OutsideSpheresOptions judged;
  py::class_<SphereModel> type(
      module, "SphereModel",
      "Spheres for the links of a robot, as fast planners check them: made with proof, read and "
      "judged. `model[link]` are those of a link (k, 4):\nx, y, z and radius (m), in its frame. In "
      "place of a Robot, all methods take a World, whose bodies take the place of links, in the "
      "model frame;\nthose of a body that moves are in its own frame.");
  type.def(py::init(&modelOf), py::arg("links"), "`links`: spheres (k, 4) by the name of the link.")
      .def_static(
          "search", &search, py::arg("robot"), py::kw_only(), py::arg("spheres") = py::none(),
          py::arg("excess") = py::none(), py::arg("pieces") = usual.pieces,
          py::arg("restarts") = usual.restarts, py::arg("rounds") = usual.rounds,
          py::arg("seed") = usual.seed, py::arg("threads") = 0, py::arg("cancel") = py::none(),
          "Spheres which together contain all collision geometry of the robot, proven; closed "
          "meshes with their inside. Either `spheres`: their number,\ndivided so that the largest "
          "reach beyond a link is small; or `excess`: m, each link gets as many as this reach "
          "needs. Others as in\nEnclosingSpheresSearch; the result does not depend on `threads`. "
          "Takes seconds to minutes; Ctrl-C and `cancel` end it. Raises ArgumentError, and "
          "UsageError for fewer\nspheres than "
          "links with geometry, and for a World with planes.")
      .def_static("load", &load, py::arg("file"), py::arg("robot"),
                  "Reads spheres for a Robot: of `save`; .yaml of cuRobo; .xrdf of cuMotion; .srdf "
                  "with MoveIt's "
                  "sphere approximations; .urdf with spheres alone. For a World: .json of `save`, "
                  "or a scene of spheres with the same bodies. Raises InputError.")
      .def("save", &save, py::arg("file"), py::arg("robot"),
           "Writes a .json; .yaml, .yml of cuRobo; .xrdf of cuMotion; .srdf, the robot's with "
           "these sphere "
           "approximations; or .urdf, the robot's with these for `<collision>`.\nOf a World: a "
           ".json, or the "
           "planning scene of these as .yaml, .yml or MoveIt's .scene. Numbers read back "
           "to the same. Raises UsageError for another ending and a file that cannot be written.")
      .def(
          "judge",
          [](const SphereModel& self, const py::object& robot, double tolerance, int mostSplits,
             int samples, unsigned threads, const Token& cancel) {
            return py::tuple(
                py::cast(judge(self, robot, tolerance, mostSplits, samples, threads, cancel)));
          },
          py::arg("robot"), py::kw_only(), py::arg("tolerance") = judged.tolerance,
          py::arg("most_splits") = judged.mostSplits, py::arg("samples") = judged.samples,
          py::arg("threads") = 0, py::arg("cancel") = py::none(),
          "A LinkSphereReport for each link of a Robot with collision geometry, or each body of a "
          "World; arguments as outside_spheres.")
      .def_property_readonly(
          "links",
          [](const SphereModel& self) {
            py::tuple names(self.links.size());
            for (std::size_t i = 0; i < names.size(); ++i) names[i] = self.links[i].link;
            return names;
          },
          "Names of the links with spheres.")
      .def(
          "__getitem__",
          [](const SphereModel& self, const std::string& link) {
            return arrayOf(linkOf(self, link).spheres);
          },
          py::arg("link"))
      .def("__len__", &SphereModel::count)
      .def("__repr__", [](const SphereModel& self) {
        return "<swept.SphereModel of " + std::to_string(self.links.size()) + " links, " +
               std::to_string(self.count()) + " spheres>";
      });
  addImmutableCopies(type);
}

}  // namespace swept::python
