// The parts that several messages are made of, in wire form and back; see wire_form.hpp.
#pragma once

#include <optional>
#include <vector>

#include "protocol/printable.hpp"
#include "transport/wire_form.hpp"

namespace demecal {

wire::Formula encode(const Tree& tree);
std::optional<Tree> decode(const wire::Formula& formula);

std::optional<Individual> decode(const wire::Individual& individual);
std::vector<wire::Individual> encode(const Population& population);
std::optional<Population> decode(const std::vector<wire::Individual>& population);

wire::IslandState encode(const IslandState& state);
std::optional<IslandState> decode(const wire::IslandState& state);

std::vector<wire::Migrants> encode(const std::vector<Migrants>& emigrations);
std::optional<std::vector<Migrants>> decode(const std::vector<wire::Migrants>& emigrations);

/// Joints and demes count from 0 inside and from 1 on the wire.
inline std::uint32_t to_wire_index(std::uint32_t index) {
  return index + 1;
}
/// What can be shown of a text.
template <class Text>
std::string decode_text(const Text& text) {
  return printable(text.to_string());
}

}  // namespace demecal
