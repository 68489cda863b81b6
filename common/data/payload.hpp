// What arms carry at the most: payloads above it are stated in another unit.
#pragma once

#include <string>

#include "data/data_set.hpp"

namespace demecal::inline data {

/// More than the strongest robots that are made carry, kg.
inline constexpr double kMostPayload_kg = 2300.0;

/// What the arm carries at the most, kg: what its maker states, or else no more than its links weigh together, where
/// the mass of each is known.
double most_payload_kg(const Robot& robot);

/// What a payload above that is: "more than any robot carries (2300 kg)".
std::string above_most_payload(const Robot& robot);

}  // namespace demecal::inline data
