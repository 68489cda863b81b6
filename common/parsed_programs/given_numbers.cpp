#include "parsed_programs/given_numbers.hpp"

#include <iterator>

namespace demecal::inline parsed_programs {

std::optional<std::size_t> GivenNumbers::at(const std::string& name, std::size_t motion, const FrameFlow& way) const {
  const auto given = given_.find(name);
  if (given == given_.end()) return std::nullopt;
  if (given->second.size() == 1) return *given->second.begin();
  const auto behind = given->second.lower_bound(motion);
  if (behind == given->second.begin()) return std::nullopt;
  const std::size_t last = *std::prev(behind);
  return way.is_straight(last, motion) ? std::optional(last) : std::nullopt;
}

}  // namespace demecal::inline parsed_programs
