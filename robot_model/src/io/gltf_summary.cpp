// SPDX-License-Identifier: BSD-3-Clause
#include "io/gltf_summary.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "io/json_place.hpp"
#include "io/json_value.hpp"
#include "io/mesh_content.hpp"
#include "io/scalar.hpp"
#include "swept/robot_model/text_file.hpp"

namespace swept::detail {

namespace {

using Number = std::int64_t;

constexpr Number kMostBytes = Number{1} << 32;
constexpr Number kMostNodes = 1'000'000;
constexpr int kDeepest = 500;

/// The parts of a file.
struct Parts {
  std::string_view json;
  Number binary = 0;  ///< bytes that follow
};

Parts partsOf(std::string_view bytes, bool isBinary, const InputSource& source) {
  if (!isBinary) return {.json = bytes};
  constexpr std::size_t kHeader = 12, kChunkHeader = 8;
  const auto number = [&](std::size_t at) {
    return std::size_t{bytesAs<std::uint32_t>(bytes.data() + at, std::endian::little)};
  };
  constexpr std::uint32_t kJson = 0x4E4F534A, kBinary = 0x004E4942;
  if (bytes.size() < kHeader + kChunkHeader || !bytes.starts_with("glTF") || number(4) != 2)
    source.fail(0, "it does not start as binary glTF of version 2 does");
  if (number(8) != bytes.size()) {
    source.fail(0, "its header says " + std::to_string(number(8)) + " bytes, and there are " +
                       std::to_string(bytes.size()));
  }
  const std::size_t json = number(kHeader), rest = bytes.size() - kHeader - kChunkHeader;
  if (number(kHeader + 4) != kJson || json > rest)
    source.fail(0, "its first part is no JSON, or is cut off");
  Parts parts{.json = bytes.substr(kHeader + kChunkHeader, json)};
  if (json == rest) return parts;
  const std::size_t next = kHeader + kChunkHeader + json;
  if (rest - json < kChunkHeader || number(next + 4) != kBinary ||
      number(next) > rest - json - kChunkHeader)
    source.fail(0, "its second part is not binary, or is cut off");
  parts.binary = static_cast<Number>(number(next));
  return parts;
}

/// Walks through what a file shows, and reads all that faces depend on.
class GltfReader {
 public:
  GltfReader(const nlohmann::json& json, Number binary, const InputSource& source)
      : root_(json, "", source.name()), binary_(binary) {}
  MeshSummary read();

 private:
  struct Mesh {
    std::uint64_t triangles = 0;
    Eigen::AlignedBox3d box;
    bool shown = false;
  };

  std::vector<JsonValue> list(const std::string& key) const {
    return root_.has(key) ? root_.at(key).elements() : std::vector<JsonValue>();
  }
  static Number orElse(const JsonValue& value, const std::string& key, Number fallback) {
    return value.has(key) ? value.at(key).whole(0, kMostBytes) : fallback;
  }
  static const JsonValue& pick(const JsonValue& index, const std::vector<JsonValue>& all) {
    return all[static_cast<std::size_t>(index.whole(0, std::ssize(all) - 1))];
  }
  void checkExtensions() const;
  Number sizeOfBuffer(const JsonValue& index) const;
  /// Returns an accessor's count. The accessor must have this type and one of these component
  /// types, each given with its size.
  Number readAccessor(const JsonValue& accessor, const std::string& type, Number width,
                      std::initializer_list<std::pair<Number, Number>> kinds) const;
  void readPrimitive(const JsonValue& primitive, Mesh& mesh) const;
  Mesh readMesh(const JsonValue& value) const;
  static Eigen::Affine3d placeOf(const JsonValue& node);
  void show(const JsonValue& index, const Eigen::Affine3d& file_from_parent, int depth);

  JsonValue root_;
  Number binary_;
  std::vector<JsonValue> buffers_, views_, accessors_, nodes_;
  std::vector<Mesh> meshes_;
  Number nodesShown_ = 0;
  MeshSummary summary_;
};

/// Extensions that concern materials and lights only.
void GltfReader::checkExtensions() const {
  for (const JsonValue& name : list("extensionsRequired")) {
    const std::string text = name.text();
    const bool isOfLooks = text.starts_with("KHR_materials_") || text == "KHR_texture_transform" ||
                           text == "KHR_texture_basisu" || text == "EXT_texture_webp" ||
                           text == "KHR_lights_punctual";
    if (!isOfLooks) name.refuse("an extension of materials, textures or lights");
  }
}

Number GltfReader::sizeOfBuffer(const JsonValue& index) const {
  const JsonValue& buffer = pick(index, buffers_);
  const Number size = buffer.at("byteLength").whole(0, kMostBytes);
  Number there = binary_;
  if (buffer.has("uri")) {
    const std::string uri = buffer.at("uri").text();
    const std::size_t comma = uri.find(";base64,");
    if (!uri.starts_with("data:") || comma == std::string::npos)
      buffer.at("uri").fail("names another file; what is needed has to be in the file itself");
    there = static_cast<Number>((uri.size() - comma - 8) / 4 * 3);
  } else if (&buffer != buffers_.data()) {
    buffer.fail("has no uri");
  }
  if (size > there)
    buffer.fail("has " + std::to_string(size) + " bytes, of which " + std::to_string(there) +
                " are there");
  return size;
}

Number GltfReader::readAccessor(const JsonValue& accessor, const std::string& type, Number width,
                                std::initializer_list<std::pair<Number, Number>> kinds) const {
  if (accessor.has("sparse")) accessor.fail("is sparse, which is not read");
  if (accessor.at("type").text() != type) accessor.at("type").refuse(type);
  const Number kind = accessor.at("componentType").whole(0, kMostBytes);
  const auto known = std::ranges::find(kinds, kind, [](const auto& each) { return each.first; });
  if (known == kinds.end()) accessor.at("componentType").refuse("of a kind that is read there");
  const Number count = accessor.at("count").whole(0, kMostBytes);
  const JsonValue view = pick(accessor.at("bufferView"), views_);
  const Number start = orElse(view, "byteOffset", 0),
               length = view.at("byteLength").whole(0, kMostBytes);
  const Number size = width * known->second, step = orElse(view, "byteStride", size);
  const Number offset = orElse(accessor, "byteOffset", 0);
  // Each is below 2^33, so that none of these overflows but the product.
  const bool fits = step >= size && step <= 252 &&
                    start + length <= sizeOfBuffer(view.at("buffer")) &&
                    (count == 0 || offset + (count - 1) * step + size <= length);
  if (!fits) accessor.fail("reaches beyond its buffer");
  return count;
}

void GltfReader::readPrimitive(const JsonValue& primitive, Mesh& mesh) const {
  constexpr Number kTriangles = 4, kFan = 6;  // and strips between them
  const Number mode = primitive.has("mode") ? primitive.at("mode").whole(0, kFan) : kTriangles;
  if (mode < kTriangles) return;  // points and lines
  if (primitive.has("targets")) primitive.fail("has targets to change into, which are not read");
  const JsonValue positions = pick(primitive.at("attributes").at("POSITION"), accessors_);
  Number corners = readAccessor(positions, "VEC3", 3, {{5126, 4}});
  if (primitive.has("indices")) {
    corners = readAccessor(pick(primitive.at("indices"), accessors_), "SCALAR", 1,
                           {{5121, 1}, {5123, 2}, {5125, 4}});
  }
  if (mode == kTriangles && corners % 3 != 0)
    primitive.fail("has " + std::to_string(corners) + " corners; 3 make a triangle");
  if (corners < 3) return;
  mesh.triangles += static_cast<std::uint64_t>(mode == kTriangles ? corners / 3 : corners - 2);
  requireFewTriangles(mesh.triangles);
  mesh.box.extend(positions.at("min").vector3());
  mesh.box.extend(positions.at("max").vector3());
}

GltfReader::Mesh GltfReader::readMesh(const JsonValue& value) const {
  Mesh mesh;
  for (const JsonValue& primitive : value.at("primitives").elements())
    readPrimitive(primitive, mesh);
  return mesh;
}

Eigen::Affine3d GltfReader::placeOf(const JsonValue& node) {
  Eigen::Affine3d place = Eigen::Affine3d::Identity();
  if (node.has("matrix")) {
    const auto values = node.at("matrix").elements(16);
    for (int i = 0; i < 16; ++i)
      place.matrix()(i % 4, i / 4) = values[static_cast<std::size_t>(i)].number();
    if (place.matrix().row(3) != Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0))
      node.at("matrix").fail("has a last row other than 0 0 0 1");
    return place;
  }
  if (node.has("translation")) place.translation() = node.at("translation").vector3();
  if (node.has("rotation")) {
    const auto values = node.at("rotation").elements(4);
    const Eigen::Quaterniond rotation(values[3].number(), values[0].number(), values[1].number(),
                                      values[2].number());
    // A larger difference is not from rounding to single precision, or to six digits.
    constexpr double kUnit = 1e-6;
    if (!(std::abs(rotation.norm() - 1.0) <= kUnit))
      node.at("rotation").fail("has another length than 1");
    place.linear() = rotation.toRotationMatrix();
  }
  if (node.has("scale")) place.linear() = place.linear() * node.at("scale").vector3().asDiagonal();
  return place;
}

void GltfReader::show(const JsonValue& index, const Eigen::Affine3d& file_from_parent, int depth) {
  const JsonValue& node = pick(index, nodes_);
  if (++nodesShown_ > kMostNodes || depth > kDeepest) {
    node.fail("is one too many: " + std::to_string(kMostNodes) + " nodes are the most, " +
              std::to_string(kDeepest) + " in each other");
  }
  if (node.has("skin")) node.fail("has a skin, which is not read");
  if (node.has("extensions") && node.at("extensions").has("EXT_mesh_gpu_instancing"))
    node.fail("has EXT_mesh_gpu_instancing, which is not read");
  const Eigen::Affine3d file_from_node = file_from_parent * placeOf(node);
  if (node.has("mesh")) {
    Mesh& mesh =
        meshes_[static_cast<std::size_t>(node.at("mesh").whole(0, std::ssize(meshes_) - 1))];
    mesh.shown = true;
    summary_.triangles += mesh.triangles;
    requireFewTriangles(summary_.triangles);
    if (mesh.triangles > 0) summary_.box.extend(mesh.box.transformed(file_from_node));
  }
  if (!node.has("children")) return;
  for (const JsonValue& child : node.at("children").elements())
    show(child, file_from_node, depth + 1);
}

MeshSummary GltfReader::read() {
  const JsonValue version = root_.at("asset").at("version");
  if (!version.text().starts_with("2.")) version.refuse("2.0");
  checkExtensions();
  buffers_ = list("buffers");
  views_ = list("bufferViews");
  accessors_ = list("accessors");
  nodes_ = list("nodes");
  const std::vector<JsonValue> meshes = list("meshes"), scenes = list("scenes");
  for (const JsonValue& mesh : meshes) meshes_.push_back(readMesh(mesh));
  if (scenes.empty()) root_.at("scenes").fail("has no scene");
  const Number scene =
      root_.has("scene") ? root_.at("scene").whole(0, std::ssize(scenes) - 1) : Number{0};
  const JsonValue& shown = scenes[static_cast<std::size_t>(scene)];
  if (shown.has("nodes"))
    for (const JsonValue& node : shown.at("nodes").elements())
      show(node, Eigen::Affine3d::Identity(), 0);
  for (std::size_t i = 0; i < meshes.size(); ++i)
    if (!meshes_[i].shown && meshes_[i].triangles > 0)
      meshes[i].fail("has faces, and no node of the scene shows it");
  return summary_;
}

}  // namespace

MeshSummary gltfSummary(std::string_view bytes, bool isBinary, const InputSource& source) {
  const Parts parts = partsOf(bytes, isBinary, source);
  if (parts.json.size() > kMaxTextBytes) {
    source.fail(0, "its JSON has more than " + std::to_string(kMaxTextBytes) +
                       " bytes, which are the most that are read of a text");
  }
  const nlohmann::json json = parseJson(std::string(parts.json), source.name());
  return GltfReader(json, parts.binary, source).read();
}

}  // namespace swept::detail
