// Which participant a worker's words come from, so that nobody else can say them.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <string>
#include <string_view>

namespace demecal {

/// What tells a network's participants apart: of DDS the GUID prefix.
using ParticipantId = std::array<std::uint8_t, 12>;

/// The participant of the worker with this name, computed from the name: another participant cannot speak for it,
/// since DDS knows no two of one GUID. It is no secret and no signature: whoever forges packets below DDS can forge it.
ParticipantId participant_of(std::string_view worker);

/// A number for a run that shows who publishes its data: nobody else can begin it, or end it while that participant is
/// there. `serial` tells its runs apart. The highest bit says that the number shows that.
std::uint64_t run_of(const ParticipantId& publisher, std::uint16_t serial);
/// Whether a run's number lets this participant publish it: it shows this one, or nobody.
bool may_publish(const ParticipantId& publisher, std::uint64_t run);
/// Whether the number shows who publishes the run.
bool shows_publisher(std::uint64_t run);

/// Whether two runs show the same publisher; of those that show nobody, whether they are one.
bool have_one_publisher(std::uint64_t a, std::uint64_t b);

/// As RTPS writes it: "01.0f.…".
std::string text_of(const ParticipantId& participant);

}  // namespace demecal
