// SPDX-License-Identifier: BSD-3-Clause
#include "io/mesh_import.hpp"

#include <assimp/MemoryIOWrapper.h>
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cmath>
#include <exception>
#include <new>
#include <string_view>
#include <utility>

#include "swept/robot_model/foreign_text.hpp"

namespace swept::detail {

namespace {

/// Shows assimp one file, held in memory, and nothing else of the file system.
class OneFile final : public Assimp::IOSystem {
 public:
  OneFile(std::string name, std::span<const std::uint8_t> bytes)
      : name_(std::move(name)), bytes_(bytes) {}
  bool Exists(const char* file) const override { return name_ == file; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    if (name_ != file || mode[0] != 'r') return nullptr;
    return new Assimp::MemoryIOStream(bytes_.data(), bytes_.size());
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  std::string name_;
  std::span<const std::uint8_t> bytes_;
};

using RowMajor4f = Eigen::Matrix<float, 4, 4, Eigen::RowMajor>;

Eigen::Matrix4d toEigen(const aiMatrix4x4& matrix) {
  return Eigen::Map<const RowMajor4f>(&matrix.a1).cast<double>();
}

/// Those that FaceMaterials::Kept keeps.
bool hasMaterials(std::span<const std::uint8_t> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return text.find("<library_effects") != std::string_view::npos;
}

/// 0xRRGGBB, or kNoColour.
std::uint32_t colourOf(const aiMaterial& material) {
  aiColor3D colour;
  if (material.GetTextureCount(aiTextureType_DIFFUSE) > 0 ||
      material.Get(AI_MATKEY_COLOR_DIFFUSE, colour) != AI_SUCCESS)
    return kNoColour;
  std::uint32_t code = 0;
  for (const float part : {colour.r, colour.g, colour.b}) {
    if (!(part >= 0.0F && part <= 1.0F)) return kNoColour;
    code = code << 8 | static_cast<std::uint32_t>(std::lround(255.0F * part));
  }
  return code;
}

void appendMesh(const aiScene& scene, const aiMesh& mesh, const Eigen::Matrix4d& file_from_node,
                MeshFileContent& content) {
  const std::uint32_t colour = mesh.mMaterialIndex < scene.mNumMaterials
                                   ? colourOf(*scene.mMaterials[mesh.mMaterialIndex])
                                   : kNoColour;
  const int first = static_cast<int>(content.vertices.size());
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D& v = mesh.mVertices[i];
    const Eigen::Vector4d p = file_from_node * Eigen::Vector4d(v.x, v.y, v.z, 1.0);
    content.vertices.emplace_back(p.head<3>());
  }
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices != 3) continue;  // a point or a line
    content.triangles.emplace_back(first + static_cast<int>(face.mIndices[0]),
                                   first + static_cast<int>(face.mIndices[1]),
                                   first + static_cast<int>(face.mIndices[2]));
    content.colours.push_back(colour);
  }
  requireFewTriangles(content.triangles.size());
}

void appendNode(const aiScene& scene, const aiNode& node, const Eigen::Matrix4d& file_from_parent,
                MeshFileContent& content) {
  const Eigen::Matrix4d file_from_node = file_from_parent * toEigen(node.mTransformation);
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    appendMesh(scene, *scene.mMeshes[node.mMeshes[i]], file_from_node, content);
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) {
    appendNode(scene, *node.mChildren[i], file_from_node, content);
  }
}

/// Too little memory is no fault of the file, but for Assimp it is as any other.
void rethrowNoMemory(const Assimp::Importer& importer) {
  try {
    if (const std::exception_ptr& thrown = importer.GetException()) std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (...) {
    return;  // the caller has a message for it
  }
}

}  // namespace

MeshFileContent importMesh(const std::string& name, std::span<const std::uint8_t> bytes) {
  Assimp::Importer importer;
  importer.SetIOHandler(new OneFile(name, bytes));
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene = importer.ReadFile(name, aiProcess_Triangulate);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    rethrowNoMemory(importer);
    throw MeshFileError("cannot be read: " + foreignText(importer.GetErrorString()));
  }
  MeshFileContent content;
  appendNode(*scene, *scene->mRootNode, Eigen::Matrix4d::Identity(), content);
  if (content.triangles.empty()) throw MeshFileError("has no triangles");
  if (!hasMaterials(bytes)) content.colours.clear();  // assimp's own grey
  return content;
}

}  // namespace swept::detail
