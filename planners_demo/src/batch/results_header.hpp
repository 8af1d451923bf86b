// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "batch/worker.hpp"
#include "output/text_output.hpp"

namespace swept {

/// The first line of a results file: what its results have in common. Its optional `time` is a
/// note: when and where the batch began.
Json resultsHeader(const Batch& batch);

/// Seconds. A run that takes longer in all is stopped.
double hardLimitOf(const Arguments& args);

/// Throws InputError, for line 1 of `source`, unless it is a header that this program can read.
void requireHeader(const Json& header, const std::string& source);

/// Throws InputError, for line 1 of `source`, naming the first field that differs. `expected` is a
/// header too; `where` says whose, for example `on the command line`.
void requireSameHeader(const Json& header, const std::string& source, const Json& expected,
                       const std::string& where);

}  // namespace swept
