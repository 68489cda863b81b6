// What is said of the closed loop wherever people read of it.
#pragma once

#include <optional>
#include <string>

namespace demecal {

/// Why the loop stopped, from the report's word, in one sentence; empty where it did not run.
std::string stop_sentence(const std::string& stopped);

/// A probability of a permutation test: "0.001", "0.24"; a dash where there is none.
std::string probability(std::optional<double> p);

/// The loop's tests of the whole model.
struct LoopStatistics {
  std::optional<double> lack_of_fit_p, explained_share, structure_left_p;
};
/// What these say, in up to three sentences; empty where nothing is known.
std::string statistics_sentences(const LoopStatistics& statistics);

}  // namespace demecal
