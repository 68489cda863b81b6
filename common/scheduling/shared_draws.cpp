#include "scheduling/shared_draws.hpp"

#include <utility>

#include "pieces/pieces.hpp"

namespace demecal::inline scheduling {

void SharedDraws::on_outcome(const Outcome& outcome) {
  const std::lock_guard lock(mutex_);
  if (pieces_[outcome.island.deme]) return;
  pieces_[outcome.island.deme] = outcome.numbers;
  ++made_elsewhere_;
}

std::size_t SharedDraws::made_elsewhere() const {
  const std::lock_guard lock(mutex_);
  return made_elsewhere_;
}

bool SharedDraws::is_made(std::size_t piece) const {
  const std::lock_guard lock(mutex_);
  return pieces_[piece].has_value();
}

void SharedDraws::put(std::size_t piece, std::vector<double> numbers) {
  const std::lock_guard lock(mutex_);
  if (!pieces_[piece]) pieces_[piece] = std::move(numbers);
}

std::vector<std::vector<double>> SharedDraws::make_rest(const DrawWork& work) {
  in_pieces(pieces_.size(), [&](std::size_t i) {
    const std::size_t piece = pieces_.size() - 1 - i;
    if (!is_made(piece)) put(piece, work.piece(piece));
  });
  const std::lock_guard lock(mutex_);
  std::vector<std::vector<double>> all;
  for (const auto& numbers : pieces_) all.push_back(*numbers);
  return all;
}

}  // namespace demecal::inline scheduling
