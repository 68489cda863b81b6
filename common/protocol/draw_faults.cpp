#include "draws/draw_work.hpp"
#include "evolution/archipelago.hpp"
#include "protocol/faults.hpp"

#include <cstddef>
#include <vector>

namespace demecal::inline protocol {

bool fit_into_message(const DrawInputs& inputs) {
  std::size_t numbers = inputs.lists.size() + inputs.tables.size();  // none is for nothing
  for (const DrawTable& table : inputs.tables) numbers += table.numbers.size();
  for (const std::vector<std::uint32_t>& list : inputs.lists) numbers += list.size();
  return numbers <= kMostDrawNumbers;
}

Fault find_draw_fault(const CalibrationData& data) {
  if (!fit_into_message(data.draws)) return "more numbers than the limit, " + std::to_string(kMostDrawNumbers);
  const Archipelago& a = data.archipelago;
  if (!data.tables.empty() || a.joints != std::vector<std::uint32_t>{0} || a.demes_per_joint != data.draws.pieces() ||
      a.topology != Topology::none || a.between_joints || a.asynchronous || a.migration_interval != 1 ||
      a.migrants != 0 || data.parameters.number_generations != 1)
    return "islands that are not those of the draws";
  return find_fault(data.draws);
}

}  // namespace demecal::inline protocol
