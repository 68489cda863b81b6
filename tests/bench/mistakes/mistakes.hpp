// What people do wrong when they bring joints and measured points together.
#pragma once

#include <functional>

#include "measured_arm.hpp"
#include "mistaken_case.hpp"

namespace demecal::bench {

struct Mistake {
  FindingKind kind;
  std::string what;
  std::function<void(MistakenCase&, RandomStream&)> make;  ///< none: it happens while the arm is measured
  Make arm{};
};

std::vector<Mistake> mistakes();

}  // namespace demecal::bench
