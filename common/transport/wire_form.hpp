// Messages in the form in which they travel (idl/calibration.idl), and back.
#pragma once

#include <optional>

#include "calibration.h"
#include "protocol/messages.hpp"

namespace demecal {

/// The wire form: joints and demes from 1, formulas as codes, text cut off at its bound.
wire::CalibrationData encode(const CalibrationData& message);
wire::IslandTask encode(const IslandTask& message);
wire::Migrants encode(const Migrants& message);
wire::Progress encode(const Progress& message);
wire::Checkpoint encode(const Checkpoint& message);
wire::Outcome encode(const Outcome& message);
wire::WorkerStatus encode(const WorkerStatus& message);
wire::Control encode(const Control& message);
wire::LoopNews encode(const LoopNews& message);

/// The message, its texts made printable; nothing where a code is unknown, a number below its first, a count disagrees
/// with another, a constant is not finite, or the run, the worker or the calibration is none. Whether the message makes
/// sense in its run is not asked here, but by protocol/faults.hpp.
std::optional<CalibrationData> decode(const wire::CalibrationData& message);
std::optional<IslandTask> decode(const wire::IslandTask& message);
std::optional<Migrants> decode(const wire::Migrants& message);
std::optional<Progress> decode(const wire::Progress& message);
std::optional<Checkpoint> decode(const wire::Checkpoint& message);
std::optional<Outcome> decode(const wire::Outcome& message);
std::optional<WorkerStatus> decode(const wire::WorkerStatus& message);
std::optional<Control> decode(const wire::Control& message);
std::optional<LoopNews> decode(const wire::LoopNews& message);

/// Formulas: codes of primitives in prefix order, with variables and constants in order of occurrence.
wire::Formula encode(const Tree& tree);
std::optional<Tree> decode(const wire::Formula& formula);

}  // namespace demecal
