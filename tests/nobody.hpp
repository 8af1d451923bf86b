// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <stdexcept>

namespace swept::test {

/// While it lives, the process is not the superuser's, to whom rights of files mean nothing.
class Nobody {
 public:
  Nobody() {
    if (was_ == 0 && seteuid(65534) != 0) throw std::runtime_error("no other user");
  }
  ~Nobody() {
    if (was_ == 0 && seteuid(0) != 0) std::abort();
  }
  Nobody(const Nobody&) = delete;
  Nobody& operator=(const Nobody&) = delete;

 private:
  uid_t was_ = geteuid();
};

}  // namespace swept::test
