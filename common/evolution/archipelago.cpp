#include "evolution/archipelago.hpp"

#include <algorithm>
#include <cmath>

#include "errors/check.hpp"

namespace demecal::inline evolution {
namespace {

std::vector<std::uint32_t> source_demes(const Archipelago& archipelago, std::uint32_t deme) {
  const std::uint32_t demes = archipelago.demes_per_joint;
  std::vector<std::uint32_t> sources;
  if (archipelago.topology == Topology::ring && demes > 1) sources.push_back((deme + demes - 1) % demes);
  if (archipelago.topology == Topology::full)
    for (std::uint32_t other = 0; other < demes; ++other)
      if (other != deme) sources.push_back(other);
  return sources;
}

std::uint32_t joint_before(const std::vector<std::uint32_t>& joints, std::uint32_t joint) {
  const auto found = std::find(joints.begin(), joints.end(), joint);
  return found == joints.begin() ? joints.back() : *(found - 1);
}

}  // namespace

std::vector<IslandKey> islands(const Archipelago& archipelago) {
  std::vector<IslandKey> keys;
  for (const std::uint32_t joint : archipelago.joints)
    for (std::uint32_t deme = 0; deme < archipelago.demes_per_joint; ++deme) keys.push_back({joint, deme});
  return keys;
}

std::vector<IslandKey> sources(const Archipelago& archipelago, IslandKey island) {
  const auto& joints = archipelago.joints;
  DEMECAL_CHECK(std::find(joints.begin(), joints.end(), island.joint) != joints.end() &&
                    island.deme < archipelago.demes_per_joint,
                "joint=" << island.joint << " deme=" << island.deme);
  std::vector<IslandKey> keys;
  for (const std::uint32_t deme : source_demes(archipelago, island.deme)) keys.push_back({island.joint, deme});
  if (archipelago.between_joints && joints.size() > 1)
    keys.push_back({joint_before(joints, island.joint), island.deme});
  return keys;
}

std::vector<IslandKey> consumers(const Archipelago& archipelago, IslandKey island) {
  std::vector<IslandKey> keys = islands(archipelago);
  std::erase_if(keys, [&](const IslandKey& key) {
    const std::vector<IslandKey> of_key = sources(archipelago, key);
    return std::find(of_key.begin(), of_key.end(), island) == of_key.end();
  });
  return keys;
}

GpParameters island_parameters(const GpParameters& parameters, const Archipelago& archipelago, std::uint32_t deme) {
  if (archipelago.spread == 0.0 || archipelago.demes_per_joint < 2) return parameters;
  const double place = 2.0 * deme / (archipelago.demes_per_joint - 1.0) - 1.0;  // -1 to 1
  const double more = 1.0 + archipelago.spread * place, less = 1.0 - archipelago.spread * place;
  GpParameters own = parameters;
  own.mutation_rate = std::min(1.0, less * parameters.mutation_rate);
  own.shrink_mutation_rate = std::min(1.0, more * parameters.shrink_mutation_rate);
  own.tournament_size =
      std::clamp(static_cast<int>(std::lround(more * parameters.tournament_size)), 1, parameters.population_size);
  return own;
}

}  // namespace demecal::inline evolution
