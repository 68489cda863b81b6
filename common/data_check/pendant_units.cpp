#include <array>
#include <cstddef>

#include "data_check/pendant.hpp"
#include "data_check/pendant_rounding.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline data_check {

void explain_by_rounded_unit(const DataSet& data, PendantComparison& result) {
  struct Unit {
    double millimetres;
    const char* word;
  };
  for (const Unit unit : {Unit{1000.0, "metres"}, Unit{10.0, "centimetres"}}) {
    DataSet read = data;
    Trial trial{data.robot.chain, {data.robot.chain.tool_m}, {}, 1};
    for (std::size_t i = 0; i < read.poses.size(); ++i) {
      *read.poses[i].position_m *= unit.millimetres;
      trial.rows.push_back({read.poses[i].joints, *read.poses[i].position_m, 0, 0, i});
    }
    PendantRounding rounding(read);
    rounding.believe(true);
    if (!rounding.accepts(fit_base_and_tools(trial).error_m, trial.rows)) continue;
    result.explained = true;
    result.findings = {std::string("It fits if the positions are in ") + unit.word + ", not in millimetres.",
                       rounding.sentence()};
    return;
  }
}

}  // namespace demecal::inline data_check
