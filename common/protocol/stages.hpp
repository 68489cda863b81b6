// Stages of a calibration, as its LoopNews state them.
#pragma once

#include "protocol/messages.hpp"

namespace demecal::inline protocol {

/// Whether nothing follows this stage.
constexpr bool is_over(LoopNews::Stage stage) {
  return stage == LoopNews::Stage::finished || stage == LoopNews::Stage::interrupted ||
         stage == LoopNews::Stage::failed;
}

}  // namespace demecal::inline protocol
