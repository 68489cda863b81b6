// Where to send the uncorrected robot so that it arrives at its nominal poses (thesis 4.2), and the errors behind that.
#pragma once

#include <string>
#include <vector>

#include "preparation/prepared.hpp"

namespace demecal {

/// A file to be written beside the data set.
struct WrittenFile {
  std::string name;
  std::string text;
};

/// False targets: nominal - (measured - nominal). Of sets whose programmed poses stand in a VAL II file, that file with
/// their translations replaced, in its own scale and rounding, all else kept: "corrected.v2", and for further files
/// "corrected-SET.v2" (with a number where that is taken). Of all other sets the positions, as "corrected.csv".
std::vector<WrittenFile> false_targets(const RawMeasurements& raw, const Prepared& prepared, FrameKind kind);

/// "errors.csv": of every pose nominal, measured and measured - nominal in base axes, the distance, how many readings,
/// their spread, and, where the cords' standard error is stated, that of x, y, z in the instrument's frame; mm.
WrittenFile errors_file(const Prepared& prepared, FrameKind kind);

}  // namespace demecal
