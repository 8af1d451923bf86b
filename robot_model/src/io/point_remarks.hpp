// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>

namespace swept::detail {

/// Remarks about points of a path: of those with one key, the first is told with the number of the
/// others.
class PointRemarks {
 public:
  void note(const std::string& key, const std::string& text, int line);
  /// In the order of the keys.
  void tell(const std::function<void(int line, const std::string& text)>& warn) const;

 private:
  struct Remark {
    std::string text;
    int line = 0;
    std::size_t further = 0;
  };
  std::map<std::string, Remark> remarks_;
};

}  // namespace swept::detail
