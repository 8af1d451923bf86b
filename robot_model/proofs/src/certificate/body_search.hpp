// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "certificate/model_json.hpp"
#include "swept/core/shapes.hpp"
#include "verify/body.hpp"

namespace swept {

/// A body and the shapes of the parts of its tree. With these the library computes in which
/// direction two parts are separated.
class SearchedBody {
 public:
  SearchedBody(const verify::Body& body, const CertifiedBody& source);

  const verify::Body& body() const { return body_; }
  /// As it is checked; of bounded parts only.
  const std::vector<CertifiedBody::Part>& parts() const { return parts_; }
  /// The shape of a node: a single element as it is, several by the hull of points on them.
  const CertifiedBody::Part& shapeOf(int node);
  double sizeOf(int node);         ///< m, radius of a ball around it
  double grownBy(int node) const;  ///< m, that what it holds may reach beyond its shape

 private:
  const verify::Body& body_;
  std::vector<CertifiedBody::Part> parts_;
  std::vector<std::optional<CertifiedBody::Part>> shapes_;  ///< per node
};

}  // namespace swept
