#include "report/harmonics_chart.hpp"

#include <fmt/format.h>

#include "report/amount.hpp"
#include "report/chart_frame.hpp"
#include "report/html_text.hpp"

namespace demecal {
namespace {

std::string stem(const LineChart& chart, const Harmonic& harmonic) {
  const double x = chart.x(harmonic.cycles), top = chart.y(1e3 * harmonic.amplitude);
  std::string marks = fmt::format("<line class=\"stem\" x1=\"{0:.2f}\" x2=\"{0:.2f}\" y1=\"{1:.2f}\" y2=\"{2:.2f}\"/>",
                                  x, chart.y(0.0), top);
  if (harmonic.standard_error) {
    marks += fmt::format("<path class=\"whisker\" d=\"M{0:.2f} {1:.2f} V{2:.2f} m-3 0 h6\"/>", x,
                         chart.y(1e3 * (harmonic.amplitude - *harmonic.standard_error)),
                         chart.y(1e3 * (harmonic.amplitude + *harmonic.standard_error)));
  }
  const std::string words =
      fmt::format("{:g} cycles per turn: {}", harmonic.cycles, amount(harmonic.amplitude, harmonic.unit));
  return marks +
         fmt::format("<circle class=\"stem\" cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"3.4\"><title>{}</title></circle>\n", x,
                     top, escaped(words));
}

}  // namespace

std::string harmonics_chart(std::uint64_t joint, const std::vector<Harmonic>& harmonics, double highest) {
  if (harmonics.empty()) return {};
  LineChart chart = line_chart(0.0, 1.04 * harmonics.back().cycles, 0.0, 1.12e3 * highest, false);
  chart.x.whole = true;
  chart.x_title = "cycles per turn";
  chart.y_title = "m" + harmonics.front().unit;
  chart.label = fmt::format("Amplitudes of the gear harmonics of joint {}", joint);
  std::string marks;
  for (const Harmonic& harmonic : harmonics) marks += stem(chart, harmonic);
  return drawn(chart, marks);
}

}  // namespace demecal
