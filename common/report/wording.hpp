// What page and terminal both say of a report: amounts, classes of effects, why the loop stopped.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/report.hpp"

namespace demecal {

/// `value` of an SI unit as it stands in a coefficient's label, with three digits and a unit of fitting size:
/// (0.000412, "rad") is "0.412 mrad", (2e-7, "rad/Nm") "0.2 µrad/Nm", (1.3e-5, "1/K") "13 ppm/K". A dash where it is
/// not finite.
std::string amount(double value, const std::string& unit);

/// The same with two digits, and small angles in arc seconds: "8 arcsec".
std::string limit_amount(double value, const std::string& unit);

/// A probability of a permutation test: "0.001", "0.24"; a dash where there is none.
std::string probability(std::optional<double> p);

/// "link geometry of joints 2 and 3 or instrument scale", "backlash or friction hysteresis of joint 2".
std::string class_words(const std::vector<ClassMember>& members);

/// "Link geometry of joint 2 or instrument scale: these poses cannot tell."; empty for an empty class.
std::string class_sentence(const std::vector<ClassMember>& members);

/// Why the loop stopped, from the report's word, in one sentence; empty where it did not run.
std::string stop_sentence(const std::string& stopped);

/// How measurements scatter, each by itself and together: "0.050 mm an axis, independent; joints repeat to 0.120 mrad".
std::string noise_sentence(const NoiseEntry& noise);

/// Whether a decoy won, or explains more than noise should; empty without decoys.
std::string decoys_sentence(const std::vector<DecoyEntry>& decoys);

/// What the loop's tests of the whole model say, in up to three sentences; empty where nothing is known.
std::string statistics_sentences(const Report& report);

}  // namespace demecal
