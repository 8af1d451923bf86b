// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <vector>

#include "swept/robot_model/checker_results.hpp"

namespace swept::python {

/// A swept.MotionCertificate. It is a type made by hand: an object takes a tenth of the time of one
/// of pybind11's, and a query makes one each time.
pybind11::object makeCertificate(MotionCertificate&& certificate);
/// The certificate of a swept.MotionCertificate; throws ArgumentTypeError for all else.
const MotionCertificate& certificateOf(pybind11::handle value, const char* argument);

/// swept.MotionCertificates: of a batch.
struct CertificateList {
  std::vector<MotionCertificate> certificates;
};

}  // namespace swept::python
