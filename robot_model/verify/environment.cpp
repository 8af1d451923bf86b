// SPDX-License-Identifier: BSD-3-Clause
#include "environment.hpp"

#include <cfenv>

namespace swept::verify {
namespace {

/// glibc's default has neither flush to zero nor denormals are zero.
class Environment {
 public:
  Environment() {
    std::fegetenv(&callers_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~Environment() { std::fesetenv(&callers_); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  std::fenv_t callers_{};
};

}  // namespace

// Arithmetic stays between the two changes: it is in `work`, which the compiler does not know here.
void inDefaultEnvironment(const std::function<void()>& work) {
  const Environment environment;
  work();
}

}  // namespace swept::verify
