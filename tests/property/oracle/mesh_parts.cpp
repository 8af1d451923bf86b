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

/// Edges that an odd number of faces has, and what they count as.
struct Cracks {
  std::vector<int> corner;  ///< per vertex the one that it counts as
  std::vector<int> apart;   ///< those that corners of such edges count as
  std::map<Edge, int> users;
};

/// Calls visit(from, to) for each piece that has a length of an edge. One with a crack is divided
/// where corners of others are near it.
template <typename Visitor>
void forEachPiece(const std::vector<Vector3d>& vertices, const Cracks& cracks, double crack,
                  int from, int to, const Visitor& visit) {
  const int first = cracks.corner[from], last = cracks.corner[to];
  if (first == last) return;
  std::map<double, int> way{{0.0, first}, {1.0, last}};
  const auto known = cracks.users.find(std::minmax(from, to));
  if (crack > 0 && known != cracks.users.end() && known->second % 2 == 1) {
    const Vector3d along = vertices[last] - vertices[first];
    for (const int at : cracks.apart) {
      const double share = (vertices[at] - vertices[first]).dot(along) / along.squaredNorm();
      const Vector3d foot = vertices[first] + share * along;
      if (share > 0 && share < 1 && (vertices[at] - foot).norm() <= 3 * crack)
        way.emplace(share, at);
    }
  }
  int before = -1;
  for (const auto& [share, at] : way) {
    if (before >= 0 && before != at) visit(before, at);
    before = at;
  }
}

Cracks cracksOf(const std::vector<Vector3d>& vertices, const std::vector<Face>& faces,
                const std::vector<char>& repeats, double crack) {
  Cracks found;
  found.corner.resize(vertices.size());
  std::iota(found.corner.begin(), found.corner.end(), 0);
  for (size_t f = 0; f < faces.size(); ++f)
    for (int k = 0; k < 3 && !repeats[f]; ++k)
      ++found.users[std::minmax(faces[f][k], faces[f][(k + 1) % 3])];
  std::vector<int> ends;
  for (const auto& [edge, count] : found.users)
    if (count % 2 == 1) ends.insert(ends.end(), {edge.first, edge.second});
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  for (const int end : ends) {
    const auto near = std::find_if(found.apart.begin(), found.apart.end(), [&](int other) {
      return (vertices[other] - vertices[end]).cwiseAbs().maxCoeff() <= crack;
    });
    if (near == found.apart.end())
      found.apart.push_back(end);
    else
      found.corner[end] = *near;
  }
  return found;
}

struct Use {
  int face;
  int direction;
};
using Uses = std::map<Edge, std::vector<Use>>;

/// Faces that alone have a piece of an edge, and those that then do: a sheet on a solid is none of
/// its sides.
std::vector<char> looseFaces(const Uses& pieces, size_t faces) {
  std::vector<char> loose(faces, 0);
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [ends, users] : pieces) {
      const auto left = std::count_if(users.begin(), users.end(),
                                      [&](const Use& use) { return !loose[use.face]; });
      if (left != 1) continue;
      for (const Use& use : users) loose[use.face] = 1;
      changed = true;
    }
  }
  return loose;
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
  const Cracks cracks = cracksOf(vertices, faces, repeats, crack);
  Uses edges;
  for (size_t f = 0; f < faces.size(); ++f)
    for (int k = 0; k < 3; ++k)
      forEachPiece(
          vertices, cracks, crack, faces[f][k], faces[f][(k + 1) % 3], [&](int from, int to) {
            edges[std::minmax(from, to)].push_back({static_cast<int>(f), from < to ? 1 : -1});
          });
  const std::vector<char> loose = looseFaces(edges, faces.size());

  std::vector<int> group(faces.size());
  std::iota(group.begin(), group.end(), 0);
  const auto root = [&](int i) {
    while (group[i] != i) i = group[i] = group[group[i]];
    return i;
  };
  for (const auto& [ends, users] : edges) {
    // Of loose faces and of others, each by themselves.
    int sample[2] = {-1, -1};
    for (const Use& use : users) {
      int& at = sample[loose[use.face] ? 1 : 0];
      if (at < 0) at = use.face;
      group[root(use.face)] = root(at);
    }
  }

  std::map<int, int> number;
  std::vector<int> part;
  for (size_t f = 0; f < faces.size(); ++f)
    part.push_back(number.try_emplace(root(static_cast<int>(f)), static_cast<int>(number.size()))
                       .first->second);
  const size_t parts = number.size();
  std::vector<char> evenWithout(parts, 1), evenWith(parts, 1), survives(parts, 0);
  for (const auto& [edge, users] : edges) {
    std::map<int, std::pair<int, int>> counts;  // per part: with repetitions, and without
    for (const Use& use : users) {
      ++counts[part[use.face]].first;
      if (!repeats[use.face]) ++counts[part[use.face]].second;
    }
    for (const auto& [at, count] : counts) {
      if (count.first % 2 == 1) evenWith[at] = 0;
      if (count.second % 2 == 1) evenWithout[at] = 0;
    }
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
    std::map<int, int> sums;
    for (const Use& use : users) sums[part[use.face]] += stays(use.face) ? use.direction : 0;
    for (const auto& [at, sum] : sums)
      if (sum != 0) out.oriented[at] = 0;
  }
  for (size_t f = 0; f < faces.size(); ++f) {
    if (!stays(static_cast<int>(f))) continue;
    out.faces.push_back(faces[f]);
    out.part.push_back(part[f]);
  }
  return out;
}

}  // namespace oracle
