// The figures that calibrations under noise are held to, one condition after the other.
#pragma once

#include <iosfwd>

#include "closed_loop/summary.hpp"
#include "run_noisy_case.hpp"

namespace demecal::bench {

struct NoiseFigure {
  std::string condition, name;
  int cases = 0;  ///< that it is taken over
  double value = 0.0;
  Bound bound{};
};

/// Of the cases of one condition, at least one. Where no model was found, or none because the data were refused, the
/// error is infinite.
std::vector<NoiseFigure> noise_figures(const std::vector<NoisyCaseFigures>& cases);

void write_noise_table(std::ostream& out, const std::vector<NoiseFigure>& figures);
/// One object a figure; `kept` is null where it has no bound.
void write_noise_json(std::ostream& out, const std::vector<NoiseFigure>& figures);
/// One object: what each run of the case said.
void write_noisy_case(std::ostream& out, const NoisyCaseFigures& figures, const Robot& robot);

}  // namespace demecal::bench
