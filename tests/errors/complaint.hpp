// What is said where a user's input is refused.
#pragma once

#include <string>

#include "errors/input_error.hpp"

namespace demecal {

/// The sentence of the InputError that `action` throws; empty where it throws none.
template <typename Action>
std::string complaint(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace demecal
