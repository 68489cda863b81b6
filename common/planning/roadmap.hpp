// Places that an arm may pass, and free motions between them: a probabilistic roadmap (Kavraki et al., 1996) whose
// motions are looked at when a way first needs them (Bohlin and Kavraki, 2000).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "kinematics/chain.hpp"
#include "planning/cell.hpp"

namespace demecal::inline planning {

class Roadmap {
 public:
  Roadmap(const FeasibleSpace& space, std::vector<JointVector> places);

  /// The places between two places by which a short free way leads; none between neighbours, nothing where these places
  /// and the motions between near ones leave no way.
  std::optional<std::vector<JointVector>> between(std::size_t from, std::size_t to);

 private:
  enum class Motion : std::uint8_t { unknown, free, blocked };
  struct Neighbour {
    std::size_t place = 0;
    double length = 0.0;
  };
  bool is_open(std::size_t from, std::size_t to);
  Motion& motion(std::size_t from, std::size_t to);

  const FeasibleSpace& space_;
  std::vector<JointVector> places_;
  std::vector<std::vector<Neighbour>> neighbours_;
  std::vector<Motion> motions_;
};

}  // namespace demecal::inline planning
