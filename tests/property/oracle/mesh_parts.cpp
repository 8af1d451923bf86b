// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_parts.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace oracle {
namespace {

using Edge = std::pair<int, int>;

struct LessPoint {
  bool operator()(const Vector3d& a, const Vector3d& b) const {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  }
};

/// Per vertex the first one at its place.
std::vector<int> firstThere(const std::vector<Vector3d>& vertices) {
  std::map<Vector3d, int, LessPoint> firstAt;
  std::vector<int> first;
  for (const Vector3d& vertex : vertices)
    first.push_back(firstAt.try_emplace(vertex, static_cast<int>(first.size())).first->second);
  return first;
}

Face inOrder(Face face) {
  std::sort(face.begin(), face.end());
  return face;
}

/// Calls visit(face, from, to) for each edge of each face that has a length.
template <typename Visitor>
void forEachEdge(const std::vector<Face>& faces, const std::vector<int>& corner,
                 const Visitor& visit) {
  for (size_t f = 0; f < faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int from = corner[faces[f][k]], to = corner[faces[f][(k + 1) % 3]];
      if (from != to) visit(f, from, to);
    }
  }
}

/// Per vertex the one that it counts as.
std::vector<int> acrossCracks(const std::vector<Vector3d>& vertices, const std::vector<Face>& faces,
                              const std::vector<char>& repeats, double crack) {
  std::vector<int> corner(vertices.size());
  std::iota(corner.begin(), corner.end(), 0);
  std::map<Edge, int> users;
  forEachEdge(faces, corner, [&](size_t f, int from, int to) {
    if (!repeats[f]) ++users[std::minmax(from, to)];
  });
  std::vector<int> ends;
  for (const auto& [edge, count] : users)
    if (count % 2 == 1) ends.insert(ends.end(), {edge.first, edge.second});
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::vector<int> apart;
  for (const int end : ends) {
    const auto near = std::find_if(apart.begin(), apart.end(), [&](int other) {
      return (vertices[other] - vertices[end]).cwiseAbs().maxCoeff() <= crack;
    });
    if (near == apart.end())
      apart.push_back(end);
    else
      corner[end] = *near;
  }
  return corner;
}

}  // namespace

MeshParts partsOf(const std::vector<Vector3d>& vertices, const std::vector<Face>& given,
                  double crack) {
  const std::vector<int> first = firstThere(vertices);
  std::vector<Face> faces;
  std::vector<char> repeats;
  std::map<Face, int> times;
  for (const Face& face : given) {
    const Face f{first[face[0]], first[face[1]], first[face[2]]};
    if (f[0] == f[1] || f[1] == f[2] || f[2] == f[0]) continue;
    faces.push_back(f);
    repeats.push_back(++times[inOrder(f)] > 1);
  }
  const std::vector<int> corner = acrossCracks(vertices, faces, repeats, crack);

  std::vector<int> group(faces.size());
  std::iota(group.begin(), group.end(), 0);
  const auto root = [&](int i) {
    while (group[i] != i) i = group[i] = group[group[i]];
    return i;
  };
  struct Use {
    int face;
    int direction;
  };
  std::map<Edge, std::vector<Use>> edges;
  forEachEdge(faces, corner, [&](size_t f, int from, int to) {
    auto& users = edges[std::minmax(from, to)];
    users.push_back({static_cast<int>(f), from < to ? 1 : -1});
    group[root(users.back().face)] = root(users.front().face);
  });

  std::map<int, int> number;
  std::vector<int> part;
  for (size_t f = 0; f < faces.size(); ++f)
    part.push_back(number.try_emplace(root(static_cast<int>(f)), static_cast<int>(number.size()))
                       .first->second);
  const size_t parts = number.size();
  std::vector<char> evenWithout(parts, 1), evenWith(parts, 1), survives(parts, 0);
  for (const auto& [edge, users] : edges) {
    const int at = part[users.front().face];
    const auto distinct =
        std::count_if(users.begin(), users.end(), [&](const Use& u) { return !repeats[u.face]; });
    if (distinct % 2 == 1) evenWithout[at] = 0;
    if (users.size() % 2 == 1) evenWith[at] = 0;
  }
  for (size_t f = 0; f < faces.size(); ++f)
    if (times[inOrder(faces[f])] % 2 == 1) survives[part[f]] = 1;

  MeshParts out;
  out.closed.assign(parts, 0);
  out.oriented.assign(parts, 1);
  const auto keepsRepeats = [&](int k) { return !evenWithout[k] && evenWith[k] && survives[k]; };
  const auto stays = [&](int f) { return !repeats[f] || keepsRepeats(part[f]); };
  for (size_t k = 0; k < parts; ++k)
    out.closed[k] = evenWithout[k] || keepsRepeats(static_cast<int>(k));
  for (const auto& [edge, users] : edges) {
    int sum = 0;
    for (const Use& use : users) sum += stays(use.face) ? use.direction : 0;
    if (sum != 0) out.oriented[part[users.front().face]] = 0;
  }
  for (size_t f = 0; f < faces.size(); ++f) {
    if (!stays(static_cast<int>(f))) continue;
    out.faces.push_back(faces[f]);
    out.part.push_back(part[f]);
  }
  return out;
}

}  // namespace oracle
