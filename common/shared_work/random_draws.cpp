#include "shared_work/random_draws.hpp"

#include <algorithm>

namespace demecal::inline shared_work {

std::size_t RandomDraws::pieces() const {
  return (std::size_t{count_.draws} + count_.of_piece - 1) / count_.of_piece;
}

std::uint32_t RandomDraws::numbers_of_piece(std::size_t number) const {
  return draws_of_piece(number) * numbers_of_draw();
}

std::uint32_t RandomDraws::draws_of_piece(std::size_t number) const {
  return std::min(count_.of_piece, count_.draws - static_cast<std::uint32_t>(number) * count_.of_piece);
}

WorkInputs RandomDraws::counted_inputs(WorkKind kind) const {
  WorkInputs inputs = empty_inputs(kind, count_.stream);
  inputs.lists.push_back({count_.draws, count_.of_piece});
  return inputs;
}

DrawCount read_draw_count(WorkReader& reader) {
  constexpr std::size_t kMostDraws = 32'768, kMostDrawsOfPiece = 64;
  const auto& count = reader.list(kMostDraws + 1, 2);
  WorkReader::require(count[0] > 0, "no draws");
  WorkReader::require(count[1] > 0 && count[1] <= kMostDrawsOfPiece, "pieces of no draws, or of too many");
  return {count[0], reader.stream(), count[1]};
}

}  // namespace demecal::inline shared_work
