// What a calibration found, as its watchers are told at its end: its causes and final figures (idl/calibration.idl is
// their wire form).
#pragma once

#include <cstdint>
#include <string>

namespace demecal::inline protocol {

/// Coordinator -> watchers, when the report is made: a cause of error that the closed loop found.
struct CauseFound {
  std::uint64_t calibration = 0;
  std::uint32_t number = 0;  ///< from 1, in the order of the report
  std::string cause;         ///< its word: "transmission"
  std::uint32_t joint = 0;   ///< from 1; 0: of the whole arm or of the instrument
  std::string label;         ///< in words: "gears of joint 2"
  double without_m =
      0.0;              ///< rms tool error without it, all else fitted again; this and what follows NaN where unknown
  double with_m = 0.0;  ///< the same with it
  double share_of_error = 0.0;
  std::string advice;

  bool operator==(const CauseFound&) const = default;
};

/// Coordinator -> watchers, when the report is made, after its causes.
struct FinalFigures {
  std::uint64_t calibration = 0;
  std::string job;  ///< its name
  std::uint32_t causes = 0;
  std::uint32_t effects = 0;         ///< that the closed loop added
  double validation_before_m = 0.0;  ///< rms tool error before the closed loop; NaN where there are no such poses
  double validation_after_m = 0.0;   ///< after it
  double accept_before_m = 0.0;
  double accept_after_m = 0.0;

  bool operator==(const FinalFigures&) const = default;
};

}  // namespace demecal::inline protocol
