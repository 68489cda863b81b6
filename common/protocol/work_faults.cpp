#include "evolution/archipelago.hpp"
#include "protocol/faults.hpp"
#include "shared_work/shared_work.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace demecal::inline protocol {

bool fit_into_message(const WorkInputs& inputs) {
  std::size_t numbers =
      inputs.lists.size() + inputs.tables.size() + inputs.numbers_of_pieces.size();  // none is for nothing
  for (const WorkTable& table : inputs.tables) numbers += table.numbers.size();
  for (const std::vector<std::uint32_t>& list : inputs.lists) numbers += list.size();
  std::size_t results = 0;
  for (const std::uint32_t count : inputs.numbers_of_pieces) results += count;
  return std::max(numbers, results) <= kMostWorkNumbers;
}

Fault find_work_fault(const CalibrationData& data) {
  if (!fit_into_message(data.work)) return "more numbers than the limit, " + std::to_string(kMostWorkNumbers);
  const Archipelago& a = data.archipelago;
  if (!data.tables.empty() || a.joints != std::vector<std::uint32_t>{0} ||
      a.demes_per_joint != data.work.numbers_of_pieces.size() || a.topology != Topology::none || a.between_joints ||
      a.asynchronous || a.migration_interval != 1 || a.migrants != 0 || data.parameters.number_generations != 1)
    return "islands that are not those of the work";
  return find_fault(data.work);
}

}  // namespace demecal::inline protocol
