// Performance criteria of ISO 9283:1998 as far as positions that were measured for calibration can give them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "acceptance/attained_pose.hpp"
#include "data/data_set.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline acceptance {

/// One criterion: its value, or why the data cannot give it.
struct Characteristic {
  std::string symbol, title;
  std::string clause;                ///< of ISO 9283
  std::optional<double> value_mm{};  ///< none: not measured
  std::string basis;                 ///< what it is of, or what is missing
};

/// AP, RP, vAP, AD, dAP and dRP, in this order.
std::vector<Characteristic> characteristics(const DataSet& data, const std::vector<AttainedPose>& poses,
                                            const CorrectedRobot& robot);

/// What of the standard is not here, in a sentence.
std::string not_implemented();

}  // namespace demecal::inline acceptance
