// SPDX-License-Identifier: BSD-3-Clause
#include "io/point_remarks.hpp"

#include "output/text_output.hpp"

namespace swept::detail {

void PointRemarks::note(const std::string& key, const std::string& text, int line) {
  const auto [remark, isFirst] = remarks_.try_emplace(key, Remark{text, line, 0});
  if (!isFirst) ++remark->second.further;
}

void PointRemarks::tell(const std::function<void(int line, const std::string& text)>& warn) const {
  for (const auto& [key, remark] : remarks_)
    warn(remark.line, remark.further == 0 ? remark.text
                                          : remark.text + "; likewise at " +
                                                countedText(remark.further, "further point"));
}

}  // namespace swept::detail
