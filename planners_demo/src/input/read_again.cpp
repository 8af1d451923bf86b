// SPDX-License-Identifier: BSD-3-Clause
#include "input/read_again.hpp"

#include <filesystem>
#include <system_error>

#include "swept/robot_model/input.hpp"

namespace swept {

void requireReadAgain(const std::string& file) {
  std::error_code error;
  const auto type = std::filesystem::status(file, error).type();
  if (type == std::filesystem::file_type::fifo || type == std::filesystem::file_type::character)
    throw InputError(file, 0, "this subcommand reads it twice, which a pipe does not allow");
}

}  // namespace swept
