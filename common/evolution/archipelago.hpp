// The islands of a job, the ways elites travel between them, and what sets the islands of a joint apart.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "fitness/parameters.hpp"

namespace demecal::inline evolution {

/// An island: one deme of one joint. Joints and demes count from 0.
struct IslandKey {
  std::uint32_t joint = 0;
  std::uint32_t deme = 0;
  auto operator<=>(const IslandKey&) const = default;
};

enum class Topology { none, ring, full };

/// Whose place immigrants take: the worst residents', or those of any but the fittest.
enum class Replacement { worst, random };

struct Archipelago {
  std::vector<std::uint32_t> joints;  ///< those that get a correction, ascending
  std::uint32_t demes_per_joint = 2;
  Topology topology = Topology::ring;
  std::uint32_t migration_interval = 10;  ///< generations per epoch
  std::uint32_t migrants = 3;             ///< elites an island sends per epoch
  bool between_joints = false;            ///< whether deme d of one joint also feeds deme d of the next joint
  bool asynchronous = false;              ///< whether islands take what migrants are there and wait for none
  Replacement replacement = Replacement::worst;
  double spread = 0.0;  ///< how far the parameters of a joint's islands lie apart, 0 to 1: see island_parameters()

  bool operator==(const Archipelago&) const = default;
};

/// All islands, by joint, then deme.
std::vector<IslandKey> islands(const Archipelago& archipelago);

/// The islands whose emigrants of the epoch before `island` takes in, in a fixed order; never itself. Ring: deme d - 1
/// of the same joint (none where there is one deme); full: every other deme of the joint; between_joints adds deme d of
/// the joint listed before (cyclic).
std::vector<IslandKey> sources(const Archipelago& archipelago, IslandKey island);

/// The islands that take in what `island` sends, by joint, then deme.
std::vector<IslandKey> consumers(const Archipelago& archipelago, IslandKey island);

/// Without a spread the parameters as they are. With one, the first island of a joint explores and the last one
/// exploits: from 1 + spread times to 1 - spread times the mutation rate, and the other way round the tournament size
/// and the shrink mutation rate, in equal steps between; each as far as its rules allow. An island alone has the mean.
GpParameters island_parameters(const GpParameters& parameters, const Archipelago& archipelago, std::uint32_t deme);

}  // namespace demecal::inline evolution
