// Migrants whose sender no task has named yet, kept until one does.
#pragma once

#include <deque>
#include <map>
#include <string>
#include <vector>

#include "protocol/messages.hpp"

namespace demecal {

/// Of each sender as many as are kept of an island: one that floods pushes out its own.
class Unproven {
 public:
  static constexpr std::size_t kMostOfOne = 4096, kMostSenders = 256;

  /// Whether nothing had to be dropped for it, nor it itself.
  bool put(const Migrants& migrants);
  /// Those of one sender that are of this run and island, which are no longer kept.
  std::vector<Migrants> take(const std::string& worker, RunId run, IslandKey island);
  /// How many each sender has sent for the run; they are no longer kept.
  std::map<std::string, std::size_t> forget(RunId run);

 private:
  std::map<std::string, std::deque<Migrants>> by_sender_;
};

}  // namespace demecal
