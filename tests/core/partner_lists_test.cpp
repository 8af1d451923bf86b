// SPDX-License-Identifier: BSD-3-Clause
// Room for more partners than offsets have bits for was noted in the lists before it was refused,
// and the next partner was written where there was no memory.
#include "broadphase/partner_lists.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <stdexcept>
#include <vector>

namespace swept {
namespace {

TEST(PartnerLists, RefuseRoomForTooManyAndStayAsTheyWere) {
  detail::PartnerLists lists;
  lists.resize(3);
  const std::vector<std::uint32_t> counts{0x80000000U, 0x80000000U, 1U};
  try {
    lists.reserve(counts);
    FAIL() << "more than 2^32 places";
  } catch (const std::length_error& error) {
    EXPECT_STREQ(error.what(),
                 "SweepAndPrune: so many pairs of near boxes that their lists would take more than "
                 "2^32 places");
  }
  lists.add(0, 2, true);
  lists.add(0, 1, false);
  ASSERT_EQ(lists.of(0).size(), 2U);
  EXPECT_EQ(lists.of(0)[0].box, 2U);
  EXPECT_EQ(lists.of(0)[0].overlaps, 1U);
  EXPECT_EQ(lists.of(0)[1].box, 1U);
  ASSERT_EQ(lists.of(1).size(), 1U);
  EXPECT_EQ(lists.of(1)[0].box, 0U);
  EXPECT_EQ(lists.of(2).size(), 1U);
}

}  // namespace
}  // namespace swept
