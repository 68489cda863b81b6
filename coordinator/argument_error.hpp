// What a command cannot do as it was called: told with exit code 10.
#pragma once

#include <stdexcept>

namespace demecal {

struct ArgumentError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace demecal
