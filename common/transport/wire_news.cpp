#include "transport/wire_population.hpp"

#include <array>
#include <utility>

namespace demecal {
namespace {

template <class Plain, class Wire, std::size_t size>
using Codes = std::array<std::pair<Plain, Wire>, size>;

constexpr Codes<LoopNews::Stage, wire::Stage, 6> kStages{{{LoopNews::Stage::preparing, wire::PREPARING},
                                                          {LoopNews::Stage::evolving, wire::EVOLVING},
                                                          {LoopNews::Stage::closing, wire::CLOSING},
                                                          {LoopNews::Stage::finished, wire::DONE},
                                                          {LoopNews::Stage::interrupted, wire::INTERRUPTED},
                                                          {LoopNews::Stage::failed, wire::FAILED}}};
constexpr Codes<LoopNews::Verdict, wire::RoundVerdict, 3> kVerdicts{{{LoopNews::Verdict::added, wire::ADDED},
                                                                     {LoopNews::Verdict::rejected, wire::REJECTED},
                                                                     {LoopNews::Verdict::none, wire::NOTHING}}};

template <class Plain, class Wire, std::size_t size>
Wire encode(const Codes<Plain, Wire, size>& codes, Plain value) {
  for (const auto& [plain, code] : codes)
    if (plain == value) return code;
  return codes.back().second;
}

template <class Plain, class Wire, std::size_t size>
std::optional<Plain> decode(const Codes<Plain, Wire, size>& codes, Wire value) {
  for (const auto& [plain, code] : codes)
    if (code == value) return plain;
  return std::nullopt;
}

}  // namespace

wire::LoopNews encode(const LoopNews& message) {
  wire::LoopNews encoded;
  encoded.calibration(message.calibration);
  encoded.round(message.round);
  encoded.run(message.run);
  encoded.stage(encode(kStages, message.stage));
  encoded.job(message.job);
  encoded.text(message.text);
  encoded.verdict(encode(kVerdicts, message.verdict));
  encoded.kind(message.kind);
  encoded.joint(message.joint);
  encoded.label(message.label);
  encoded.validation_before_m(message.validation_before_m);
  encoded.validation_after_m(message.validation_after_m);
  return encoded;
}

std::optional<LoopNews> decode(const wire::LoopNews& message) {
  const auto stage = decode(kStages, message.stage());
  const auto verdict = decode(kVerdicts, message.verdict());
  if (!stage || !verdict || message.calibration() == 0) return std::nullopt;
  return LoopNews{.calibration = message.calibration(),
                  .round = message.round(),
                  .run = message.run(),
                  .stage = *stage,
                  .job = decode_text(message.job()),
                  .text = decode_text(message.text()),
                  .verdict = *verdict,
                  .kind = decode_text(message.kind()),
                  .joint = message.joint(),
                  .label = decode_text(message.label()),
                  .validation_before_m = message.validation_before_m(),
                  .validation_after_m = message.validation_after_m()};
}

}  // namespace demecal
