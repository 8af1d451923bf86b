// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "handles.hpp"
#include "swept/proofs/task_proof.hpp"

namespace swept::python {

/// swept.TaskPhase.
struct PhaseHandle {
  RobotHandle robot;
  TaskPhase phase;
  bool isProven = false;  ///< `phase` has a certificate with clearances
};

}  // namespace swept::python
