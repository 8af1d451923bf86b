// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace soak {

/// One body of a world: which of the stage's places is taken, and by which of its forms.
struct Choice {
  int place;
  int form;
  bool operator==(const Choice&) const = default;
};

/// The bodies of a world in their order, as `3a.0c.12b`: place 3 in form a, ...; `none` for none.
/// With the stage and its seed it tells the world exactly.
using WorldKey = std::vector<Choice>;

std::string toString(const WorldKey& key);
/// Throws std::invalid_argument for text that toString does not write, places from `places` on,
/// forms from `forms` on, and a place taken twice.
WorldKey parseWorldKey(std::string_view text, int places, int forms);

}  // namespace soak
