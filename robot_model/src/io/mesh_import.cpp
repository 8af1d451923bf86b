// SPDX-License-Identifier: BSD-3-Clause
#include "io/mesh_import.hpp"

#include <assimp/MemoryIOWrapper.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <exception>
#include <new>
#include <utility>

#include "rounding/error_model.hpp"
#include "swept/robot_model/foreign_text.hpp"

namespace swept::detail {

namespace {

/// A file system for assimp that holds one file, in memory.
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

/// The transform of one of assimp's nodes, with those above it: how it places its meshes, and a
/// bound on the error of single precision in what it places.
class NodePlacement {
 public:
  /// The transform of `node`, a child of this node.
  NodePlacement of(const aiNode& node) const {
    const Eigen::Matrix4d matrix = toEigen(node.mTransformation);
    if (matrix.isIdentity(0.0)) return *this;
    const Eigen::Matrix3d linear = matrix.topLeftCorner<3, 3>();
    // Of the true offset, too.
    const double offset =
        matrix.topRightCorner<3, 1>().stableNorm() * (1.0 + 2.0 * kNumberRoundings * kSingle);
    // The entries are made of a unit quaternion and a scale in some 30 roundings of the length of
    // their column, or are those of the file. The offset is that of the file.
    const double linearError =
        (linear.isIdentity(0.0) ? kNumberRoundings : kNodeRoundings * linear.stableNorm()) *
        kSingle;
    constexpr double kNormError = 1e-12;
    const double stretch = linear.jacobiSvd().singularValues()[0] * (1.0 + kNormError);
    NodePlacement own;
    own.file_from_node_ = file_from_node_ * matrix;
    own.offsetError_ =
        offsetError_ + linearError_ * offset + stretch_ * kNumberRoundings * kSingle * offset;
    own.linearError_ = linearError_ * (stretch + linearError) + stretch_ * linearError;
    own.stretch_ = stretch_ * stretch;
    return own;
  }
  Eigen::Vector3d operator()(const aiVector3D& v) const {
    return (file_from_node_ * Eigen::Vector4d(v.x, v.y, v.z, 1.0)).head<3>();
  }
  /// Bound on the error of points no farther than this from the node's origin.
  double error(double distance) const {
    return offsetError_ + (linearError_ + stretch_ * kSingle) * distance;
  }

 private:
  Eigen::Matrix4d file_from_node_ = Eigen::Matrix4d::Identity();
  double stretch_ = 1.0;  ///< bound on the norm of its linear part
  /// Bounds on the norms of the errors of its linear part and of its offset.
  double linearError_ = 0.0, offsetError_ = 0.0;
};

void appendMesh(const aiMesh& mesh, const NodePlacement& place, MeshFileContent& content) {
  const int first = static_cast<int>(content.vertices.size());
  double farthest = 0.0;
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D& v = mesh.mVertices[i];
    farthest = std::max(farthest, Eigen::Vector3d(v.x, v.y, v.z).norm());
    content.vertices.emplace_back(place(v));
  }
  content.error = std::max(content.error, place.error(farthest));
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices != 3) continue;  // a point or a line
    content.triangles.emplace_back(first + static_cast<int>(face.mIndices[0]),
                                   first + static_cast<int>(face.mIndices[1]),
                                   first + static_cast<int>(face.mIndices[2]));
  }
  requireFewTriangles(content.triangles.size());
}

void appendNode(const aiScene& scene, const aiNode& node, const NodePlacement& parent,
                MeshFileContent& content) {
  const NodePlacement place = parent.of(node);
  for (unsigned i = 0; i < node.mNumMeshes; ++i)
    appendMesh(*scene.mMeshes[node.mMeshes[i]], place, content);
  for (unsigned i = 0; i < node.mNumChildren; ++i)
    appendNode(scene, *node.mChildren[i], place, content);
}

/// Too little memory is not the file's fault, but assimp reports it like any other error.
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
  const aiScene* scene = importer.ReadFile(name, aiProcess_Triangulate);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    rethrowNoMemory(importer);
    throw MeshFileError("cannot be read: " + foreignText(importer.GetErrorString()));
  }
  MeshFileContent content;
  appendNode(*scene, *scene->mRootNode, NodePlacement(), content);
  if (content.triangles.empty()) throw MeshFileError("has no triangles");
  keepUsedVertices(content);
  return content;
}

}  // namespace swept::detail
