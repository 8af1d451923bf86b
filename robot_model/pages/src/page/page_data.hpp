// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "page/page_content.hpp"
#include "swept/pages/page.hpp"

namespace swept {

struct Page::Data {
  enum class Kind { Nothing, States, Motions, Paths, Trajectories };

  std::shared_ptr<const Checker> checker;
  PageOptions options;
  PageContent content;
  std::vector<Finding> findings;  ///< of each motion, path or trajectory
  Kind kind = Kind::Nothing;

  void require(Kind wanted) {
    if (kind != Kind::Nothing && kind != wanted)
      throw std::invalid_argument(
          "a page has either states, or motions, or paths, or trajectories");
    kind = wanted;
  }
  Finding addMotion(const std::string& label, const std::vector<double>& from,
                    const std::vector<double>& to);
  PageContent judged() const;
  /// What judged() says, and all that is shown. Throws std::invalid_argument for nothing.
  Json json() const;
};

}  // namespace swept
