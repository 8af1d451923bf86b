// SPDX-License-Identifier: BSD-3-Clause
#include "bodies.hpp"

#include <stdexcept>
#include <utility>

#include "arrays.hpp"
#include "shapes.hpp"

namespace py = pybind11;

namespace swept::python {

WorldBody bodyOf(const std::string& name, const py::object& shape, const py::object& pose) {
  WorldBody body{.name = name};
  for (auto& [piece, world_from_shape] : piecesOf(shape, pose))
    body.parts.push_back({std::move(piece), world_from_shape});
  return body;
}

AttachedBody attachedOf(const std::string& name, const std::string& link, const py::object& shape,
                        const py::object& pose, std::vector<std::string> touchLinks) {
  AttachedBody body{.name = name, .link = link};
  for (auto& [piece, link_from_shape] : piecesOf(shape, pose))
    body.parts.push_back({std::move(piece), link_from_shape});
  body.touchLinks = std::move(touchLinks);
  return body;
}

MovingObstacle obstacleOf(const std::string& name, const py::object& shape, const py::object& times,
                          const py::object& poses) {
  MovingObstacle obstacle{.name = name};
  for (auto& [piece, body_from_shape] : piecesOf(shape, py::none()))
    obstacle.parts.push_back({std::move(piece), body_from_shape});
  const std::size_t count = py::len(poses);
  const Table at = readVector(times, "times", 0);
  if (at.columns() != count)
    throw std::invalid_argument("poses: expected as many as times, " +
                                std::to_string(at.columns()) + "; got " + std::to_string(count));
  for (std::size_t i = 0; i < count; ++i)
    obstacle.waypoints.push_back(
        {at.numbers()[i], readPose(py::object(poses[py::int_(i)]), "poses")});
  return obstacle;
}

}  // namespace swept::python
