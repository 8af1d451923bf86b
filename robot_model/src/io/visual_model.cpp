// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/visual_model.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "io/mesh_store.hpp"
#include "io/visual_materials.hpp"
#include "io/visual_mesh.hpp"
#include "io/warning_kinds.hpp"
#include "io/xml.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/text_file.hpp"
#include "text/numbers.hpp"

namespace swept {

namespace {

using Element = tinyxml2::XMLElement;
using VisualShape = decltype(Visual::shape);

constexpr const char* kLeftOut = " left out of what is shown";

/// A `<visual>` that cannot be shown, and the kind of what is wrong with it.
struct Unusable {
  std::string problem, kind;
};

class VisualReader {
 public:
  VisualReader(detail::XmlFile& xml, const VisualLimits& limits)
      : xml_(xml),
        limits_(limits),
        warnings_(xml.source()),
        materials_(xml, warnings_),
        files_(detail::importPlaceOf(xml.source().options())) {}

  VisualModel read();

 private:
  LinkVisuals linkVisuals(Element& link, const std::string& name);
  std::vector<Visual> visuals(Element& visual, const std::string& owner,
                              const std::optional<Colour>& colour);
  Eigen::Isometry3d origin(Element& visual, const std::string& owner);
  VisualShape primitive(const Element& shape, const std::string& owner);
  const std::vector<detail::ColouredMesh>& meshes(const Element& shape, const std::string& owner);
  std::vector<detail::ColouredMesh> readMeshes(const std::filesystem::path& file,
                                               const Eigen::Vector3d& scale);
  void shareOut(VisualModel& model);

  using Key = std::pair<std::filesystem::path, std::array<double, 3>>;
  detail::XmlFile& xml_;
  const VisualLimits& limits_;
  detail::WarningKinds warnings_;
  detail::VisualMaterials materials_;
  detail::MeshFileReader files_;
  std::map<Key, std::vector<detail::ColouredMesh>> meshes_;
  std::map<Key, std::string> unusable_;  ///< why
};

VisualModel VisualReader::read() {
  VisualModel model;
  Element& robot = xml_.robot();
  for (Element* link = robot.FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link")) {
    const char* const name = link->Attribute("name");
    if (name == nullptr || link->FirstChildElement("visual") == nullptr) continue;
    model.links.push_back(linkVisuals(*link, name));
    model.leftOut += model.links.back().leftOut;
  }
  shareOut(model);
  warnings_.flush();
  return model;
}

LinkVisuals VisualReader::linkVisuals(Element& link, const std::string& name) {
  LinkVisuals result{.link = name, .visuals = {}, .colour = {}, .leftOut = 0};
  const std::string owner = "link '" + name + "'";
  bool first = true;
  for (Element* element = link.FirstChildElement("visual"); element != nullptr;
       element = element->NextSiblingElement("visual")) {
    const std::optional<Colour> colour = materials_.colourOf(*element, owner);
    if (first) result.colour = colour;
    if (result.colour != colour) result.colour.reset();
    first = false;
    try {
      for (Visual& visual : visuals(*element, owner, colour))
        result.visuals.push_back(std::move(visual));
    } catch (const Unusable& unusable) {
      warnings_.add(element->GetLineNum(), unusable.problem + ": it is" + kLeftOut,
                    unusable.kind + ": they are" + kLeftOut);
      ++result.leftOut;
    }
  }
  return result;
}

std::vector<Visual> VisualReader::visuals(Element& visual, const std::string& owner,
                                          const std::optional<Colour>& colour) {
  try {
    const Eigen::Isometry3d pose = origin(visual, owner);
    Element* const geometry = visual.FirstChildElement("geometry");
    Element* const shape = geometry == nullptr ? nullptr : geometry->FirstChildElement();
    if (shape == nullptr)
      xml_.fail(visual, "<visual> of " + owner + " has no <geometry> with a shape");
    if (std::string_view(shape->Name()) != "mesh")
      return {{primitive(*shape, owner), pose, colour, shape->Name()}};
    std::vector<Visual> parts;
    for (const detail::ColouredMesh& part : meshes(*shape, owner)) {
      parts.push_back({part.mesh, pose, colour, shape->Attribute("filename")});
      if (part.colour == detail::kNoColour) continue;
      const auto channel = [&](int shift) { return double(part.colour >> shift & 0xFFU) / 255.0; };
      parts.back().colour = Colour{channel(16), channel(8), channel(0), 1.0};
    }
    return parts;
  } catch (const InputError& error) {
    throw Unusable{error.message(), "# elements <visual> cannot be read"};
  } catch (const std::invalid_argument& error) {
    throw Unusable{"<visual> of " + owner + ": " + error.what(),
                   "# elements <visual> cannot be read"};
  }
}

Eigen::Isometry3d VisualReader::origin(Element& visual, const std::string& owner) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const Element* const element = visual.FirstChildElement("origin");
  if (element == nullptr) return pose;
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  const Eigen::Vector3d angles = xml_.vector(*element, "rpy", owner, zero);
  pose.translation() = xml_.vector(*element, "xyz", owner, zero);
  // About the fixed axes x, y, z, in this order.
  pose.linear() = (Eigen::AngleAxisd(angles.z(), Eigen::Vector3d::UnitZ()) *
                   Eigen::AngleAxisd(angles.y(), Eigen::Vector3d::UnitY()) *
                   Eigen::AngleAxisd(angles.x(), Eigen::Vector3d::UnitX()))
                      .toRotationMatrix();
  return pose;
}

VisualShape VisualReader::primitive(const Element& shape, const std::string& owner) {
  const std::string_view name = shape.Name();
  if (name == "box") return makeBox(xml_.vector(shape, "size", owner));
  const auto radius = [&] { return xml_.notNegative(shape, "radius", owner); };
  const auto length = [&] { return xml_.notNegative(shape, "length", owner); };
  if (name == "sphere") return makeSphere(radius());
  if (name == "cylinder") return makeCylinder(radius(), length());
  if (name == "capsule") return makeCapsule(radius(), length());
  xml_.fail(shape, "<" + std::string(name) + "> in <visual> of " + owner +
                       " is unknown; allowed are box, cylinder, sphere, capsule and mesh");
}

const std::vector<detail::ColouredMesh>& VisualReader::meshes(const Element& shape,
                                                              const std::string& owner) {
  const std::string reference = xml_.text(shape, "filename", owner);
  const Eigen::Vector3d scale = xml_.vector(shape, "scale", owner, Eigen::Vector3d::Ones());
  const std::string name = "mesh '" + reference + "' of <visual> of " + owner;
  const detail::MeshPlace place = detail::placeOfMesh(reference, xml_.source());
  if (!place.problem.empty())
    throw Unusable{name + place.problem, "# meshes of <visual> are not found"};
  const Key key{place.file, {scale.x(), scale.y(), scale.z()}};
  if (const auto known = meshes_.find(key); known != meshes_.end()) return known->second;
  if (!unusable_.contains(key)) {
    try {
      return meshes_.emplace(key, readMeshes(place.file, scale)).first->second;
    } catch (const detail::MeshFileError& error) {
      unusable_.emplace(key, error.what());
    }
  }
  throw Unusable{name + " " + unusable_[key], "# meshes of <visual> cannot be used"};
}

std::vector<detail::ColouredMesh> VisualReader::readMeshes(const std::filesystem::path& file,
                                                           const Eigen::Vector3d& scale) {
  auto parts = detail::colouredMeshes(files_.readWithColours(file), scale);
  if (parts.empty()) throw detail::MeshFileError("is too large when it is scaled");
  // At once, so that many large files do not stay in memory.
  for (const detail::ColouredMesh& part : parts) detail::makeCoarser(*part.mesh, limits_.triangles);
  return parts;
}

/// Meshes that are used several times count once.
void VisualReader::shareOut(VisualModel& model) {
  std::vector<std::size_t> counts;
  for (const auto& [key, parts] : meshes_)
    for (const detail::ColouredMesh& part : parts) counts.push_back(part.mesh->triangles.size());
  const std::size_t share = detail::evenShare(counts, limits_.triangles);
  for (const auto& [key, parts] : meshes_)
    for (const detail::ColouredMesh& part : parts) {
      detail::makeCoarser(*part.mesh, share);
      model.triangles += part.mesh->triangles.size();
      model.trianglesOfFile += part.mesh->trianglesOfFile;
    }
}

}  // namespace

const LinkVisuals* VisualModel::find(std::string_view link) const {
  const auto found = std::ranges::find(links, link, &LinkVisuals::link);
  return found == links.end() ? nullptr : &*found;
}

VisualModel VisualModel::parse(const std::string& urdfText, const std::string& urdfName,
                               const LoadOptions& options, const VisualLimits& limits) {
  if (detail::inForeignEnvironment())
    return inDefaultEnvironment([&] { return parse(urdfText, urdfName, options, limits); });
  const detail::InputSource source(urdfName, options);
  detail::XmlFile xml(urdfText, source);
  return VisualReader(xml, limits).read();
}

VisualModel VisualModel::load(const std::filesystem::path& urdf, const LoadOptions& options,
                              const VisualLimits& limits) {
  return parse(readTextFile(urdf), urdf.string(), options, limits);
}

}  // namespace swept
