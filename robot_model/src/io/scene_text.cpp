// SPDX-License-Identifier: BSD-3-Clause
#include <sstream>
#include <stdexcept>
#include <vector>

#include "io/mesh_store.hpp"
#include "io/scene.hpp"
#include "io/zero_sizes.hpp"
#include "text/numbers.hpp"

namespace swept::detail {

namespace {

struct Token {
  std::string text;
  int line;
};

/// The words of the file with their lines. What follows a `*` is one word up to the end of the
/// line: ids may hold spaces.
std::vector<Token> tokenize(const std::string& text) {
  std::vector<Token> tokens;
  std::istringstream stream(text);
  std::string row;
  for (int line = 1; std::getline(stream, row); ++line) {
    std::istringstream words(row);
    std::string word;
    while (words >> word) {
      tokens.push_back({word, line});
      if (word != "*") continue;
      std::getline(words >> std::ws, word);
      word.erase(word.find_last_not_of(" \t\r") + 1);
      tokens.push_back({words.fail() ? "" : word, line});
    }
  }
  return tokens;
}

class SceneTextReader {
 public:
  SceneTextReader(const std::string& text, const InputSource& source)
      : tokens_(tokenize(text)), source_(source), warnings_(source) {}
  World read();

 private:
  const Token& next(const std::string& expected);
  double number(const std::string& meaning);
  double size(const std::string& meaning);
  int count(const std::string& meaning);
  Eigen::Vector3d vector(const std::string& meaning);
  Eigen::Isometry3d pose();
  bool hasObjectPose() const;
  void readObject();
  Shape readShape();
  Shape readPlane();
  Shape readMesh(int line);
  [[noreturn]] void fail(int line, const std::string& message) const;

  std::vector<Token> tokens_;
  std::size_t at_ = 0;
  const InputSource& source_;
  WarningKinds warnings_;
  std::string owner_;  ///< `object 'x': `, in front of messages
  std::string id_;
  World world_;
};

void SceneTextReader::fail(int line, const std::string& message) const {
  source_.fail(line, owner_ + message);
}

const Token& SceneTextReader::next(const std::string& expected) {
  if (at_ == tokens_.size()) {
    fail(tokens_.empty() ? 1 : tokens_.back().line,
         "the file ends where " + expected + " should follow");
  }
  return tokens_[at_++];
}

double SceneTextReader::number(const std::string& meaning) {
  const Token& token = next(meaning);
  const auto value = parseNumber(token.text);
  if (!value) fail(token.line, meaning + " is '" + token.text + "'; it must be a finite number");
  return *value;
}

double SceneTextReader::size(const std::string& meaning) {
  const double value = number(meaning);
  const Token& token = tokens_[at_ - 1];
  if (!(value >= 0.0))
    fail(token.line, meaning + " is '" + token.text + "'; it must be 0 or greater");
  return value;
}

int SceneTextReader::count(const std::string& meaning) {
  const double value = number(meaning);
  const Token& token = tokens_[at_ - 1];
  if (!(value >= 0.0 && value <= 1e8) || value != static_cast<int>(value)) {
    fail(token.line, meaning + " is '" + token.text + "'; it must be a whole number of at least 0");
  }
  return static_cast<int>(value);
}

Eigen::Vector3d SceneTextReader::vector(const std::string& meaning) {
  const double x = number(meaning);
  const double y = number(meaning);
  const double z = number(meaning);
  return {x, y, z};
}

Eigen::Isometry3d SceneTextReader::pose() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = vector("a position");
  Eigen::Vector4d q;
  for (double& value : q) value = number("a quaternion");
  const auto unit = unitQuaternion(q);
  if (!unit) {
    fail(tokens_[at_ - 1].line, "the quaternion (x, y, z, w) has length " + formatNumber(q.norm()) +
                                    "; it must be 1 to within 0.01");
  }
  pose.linear() = unit->toRotationMatrix();
  return pose;
}

/// Since Noetic the line after the id is a position; before, it was the number of shapes.
bool SceneTextReader::hasObjectPose() const {
  return at_ + 1 < tokens_.size() && tokens_[at_].line == tokens_[at_ + 1].line;
}

World SceneTextReader::read() {
  // The first line is the scene's name, which means nothing here; some writers leave it out.
  if (!tokens_.empty() && tokens_[0].text != "*" && tokens_[0].text != ".") {
    while (at_ < tokens_.size() && tokens_[at_].line == tokens_[0].line) ++at_;
  }
  for (;;) {
    owner_.clear();
    const Token& marker = next("'*' or '.'");
    if (marker.text == ".") break;  // MoveIt reads no further
    if (marker.text != "*") {
      fail(marker.line, "'" + marker.text + "' where '*' (an object) or '.' (the end) should be");
    }
    readObject();
  }
  if (at_ != tokens_.size())
    fail(tokens_[at_].line, "'" + tokens_[at_].text + "' follows the '.' that ends the scene");
  warnings_.flush();
  return std::move(world_);
}

void SceneTextReader::readObject() {
  const Token& name = next("the id of an object");
  id_ = name.text;
  if (id_.empty()) fail(name.line, "an object has no id");
  owner_ = "object '" + id_ + "': ";
  if (world_.find(id_) != nullptr) fail(name.line, "a second object has this id");
  const bool withPose = hasObjectPose();
  const Eigen::Isometry3d world_from_object = withPose ? pose() : Eigen::Isometry3d::Identity();
  WorldBody body;
  body.name = id_;
  const int shapes = count("the number of shapes");
  for (int i = 0; i < shapes; ++i) {
    const Shape shape = readShape();
    warnOfZeroSize(shape, tokens_[at_ - 1].line, "object '" + id_ + "'", warnings_);
    body.parts.push_back({shape, world_from_object * pose()});
    for (int c = 0; c < 4; ++c) number("a colour");
  }
  if (withPose) {
    const int subframes = count("the number of subframes");
    for (int i = 0; i < subframes; ++i) {
      next("the name of a subframe");
      pose();
    }
  }
  if (body.parts.empty()) fail(name.line, "it has no shapes");
  try {
    world_.add(std::move(body));
  } catch (const std::invalid_argument& error) {
    fail(name.line, error.what());
  }
}

Shape SceneTextReader::readShape() {
  const Token& type = next("a shape");
  if (type.text == "sphere") return makeSphere(size("the radius of a sphere"));
  if (type.text == "box") {
    const double x = size("the size of a box");
    const double y = size("the size of a box");
    const double z = size("the size of a box");
    return makeBox({x, y, z});
  }
  if (type.text == "cylinder") {
    const double radius = size("the radius of a cylinder");
    return makeCylinder(radius, size("the length of a cylinder"));
  }
  if (type.text == "cone") {
    const double radius = size("the radius of a cone");
    return makeCone(radius, size("the height of a cone"));
  }
  if (type.text == "plane") return readPlane();
  if (type.text == "mesh") return readMesh(type.line);
  fail(type.line,
       "the shape '" + type.text +
           "' is not supported; allowed are box, sphere, cylinder, cone, plane and mesh");
}

/// The points with a x + b y + c z + d = 0.
Shape SceneTextReader::readPlane() {
  const Eigen::Vector3d normal = vector("a plane's normal");
  const int line = tokens_[at_ - 1].line;
  const double d = number("a plane's offset");
  try {
    return makePlane(normal, -d);
  } catch (const std::invalid_argument& error) {
    fail(line, error.what());
  }
}

Shape SceneTextReader::readMesh(int line) {
  const int vertexCount = count("the number of vertices");
  const int triangleCount = count("the number of triangles");
  std::vector<Eigen::Vector3d> vertices;
  for (int i = 0; i < vertexCount; ++i) vertices.push_back(vector("a vertex"));
  std::vector<Eigen::Vector3i> triangles;
  for (int i = 0; i < triangleCount; ++i) {
    const int a = count("a vertex index");
    const int b = count("a vertex index");
    const int c = count("a vertex index");
    triangles.emplace_back(a, b, c);
  }
  try {
    const TriangleMesh mesh = TriangleMesh::build(vertices, triangles);
    warnIfOpen(mesh, id_, line, source_);
    return mesh;
  } catch (const std::invalid_argument& error) {
    fail(line, std::string("the mesh cannot be used: ") + error.what());
  }
}

}  // namespace

World readSceneText(const std::string& text, const InputSource& source) {
  return SceneTextReader(text, source).read();
}

}  // namespace swept::detail
