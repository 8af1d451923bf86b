// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>

#include "mesh_samples.hpp"
#include "swept/core/bvh/bvh_model.hpp"

namespace swept::test {

template <typename BV>
BvhModel<BV> modelOf(const Soup& soup, BvhOptions<BV> options = {}) {
  BvhModel<BV> model(std::move(options));
  model.begin(soup.vertices.size(), soup.triangles.size());
  model.addMesh(soup.vertices, soup.triangles);
  model.end();
  return model;
}

}  // namespace swept::test
