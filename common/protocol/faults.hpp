// Whether a received message may be acted on: what is wrong with it, or nothing. Whoever receives a message asks first,
// so that no message from elsewhere can break a precondition of the rooms below.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "effect_sets/set_training.hpp"
#include "evolution/population.hpp"
#include "fitness/parameters.hpp"
#include "protocol/messages.hpp"
#include "shared_work/shared_work.hpp"

namespace demecal::inline protocol {

/// Why a message is refused: a sentence for a log.
using Fault = std::optional<std::string>;

/// More than any job needs is refused: memory is claimed by these numbers.
inline constexpr std::size_t kMostJoints = 64;
inline constexpr std::uint32_t kMostDemes = 1024;  ///< islands of one joint
inline constexpr int kMostIndividuals = 100'000;   ///< of one island
inline constexpr int kMostGenerations = 100'000'000;
inline constexpr int kMostAttempts = 100'000;  ///< at a valid offspring
inline constexpr std::size_t kMostRows = 1'000'000;
inline constexpr std::size_t kMostColumns = 2890;           ///< of all effects: their products fit into a message
inline constexpr std::size_t kMostWorkNumbers = 8'000'000;  ///< of all lists and tables: they fit into a message
inline constexpr std::size_t kMostSetEffects = 1000;        ///< effects of a set
inline constexpr int kMostVariations = 100'000'000;         ///< of sets, on all islands
inline constexpr std::uint32_t kMostSlots = 4096;           ///< of one worker

/// Parameters hold their rules and the bounds above; joints ascending and below kMostJoints; counts positive; one table
/// per joint whose columns are finite and as long as each other, with weights from 0 to 1 and no more seeds than a
/// population holds; or matrices of effects that belong together, no tables, and the islands of a SetIsland; or what
/// work is done from, and an island for each of its pieces.
Fault find_fault(const CalibrationData& data);

/// The same where sets of effects are bred, but for what all data have in common.
Fault find_set_fault(const CalibrationData& data);
/// The same where work is done in pieces.
Fault find_work_fault(const CalibrationData& data);

/// The island is one of the run's, worker named, the start state consistent, recent emigrations its own. As for all
/// that follow, `data` is that of the message's run; a message of another run is a fault.
Fault find_fault(const IslandTask& task, const CalibrationData& data);
/// The island is one of the run's, the epoch is one it can have completed, no more individuals than agreed, all valid.
/// Who sends them is not asked: that is a matter of who was given the island.
Fault find_fault(const Migrants& migrants, const CalibrationData& data);
/// The island is one of the run's, counters and figures are ones it can reach, the worker is named.
Fault find_fault(const Progress& progress, const CalibrationData& data);
/// The island is one of the run's, the state consistent, recent emigrations its own.
Fault find_fault(const Checkpoint& checkpoint, const CalibrationData& data);
/// The island is one of the run's, all generations are bred, the front valid, the worker named.
Fault find_fault(const Outcome& outcome, const CalibrationData& data);

/// Whether they are few enough numbers for a message.
bool fit_into_message(const WorkInputs& inputs);

/// The worker is named, has from 1 to kMostSlots slots, and waited for a share from 0 to 1.
Fault find_fault(const WorkerStatus& status);

/// Sets of effects: every effect is one of these and none stands twice, as many as allowed, every fitness at least 0.
Fault find_fault(const Population& population, const SetTraining& sets);

/// A population of a joint with `variables` variables: every tree valid, no deeper and no longer than allowed, every
/// fitness at least 0 (infinite is allowed, NaN is not).
Fault find_fault(const Population& population, const GpParameters& parameters, int variables);

/// So many numbers, all of them finite.
bool is_finite_column(const std::vector<double>& column, std::size_t rows);

}  // namespace demecal::inline protocol
