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

/// As RTPS writes it: "01.0f.…".
std::string text_of(const ParticipantId& participant);

}  // namespace demecal
