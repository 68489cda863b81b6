#include "scheduling/shared_pieces.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "pieces/pieces.hpp"

namespace demecal::inline scheduling {

void SharedPieces::on_outcome(const Outcome& outcome) {
  const std::lock_guard lock(mutex_);
  if (pieces_[outcome.island.deme]) return;
  pieces_[outcome.island.deme] = outcome.numbers;
  ++done_elsewhere_;
}

std::size_t SharedPieces::done_elsewhere() const {
  const std::lock_guard lock(mutex_);
  return done_elsewhere_;
}

bool SharedPieces::is_done(std::size_t piece) const {
  const std::lock_guard lock(mutex_);
  return pieces_[piece].has_value();
}

void SharedPieces::put(std::size_t piece, std::vector<double> numbers) {
  const std::lock_guard lock(mutex_);
  if (!pieces_[piece]) pieces_[piece] = std::move(numbers);
}

double SharedPieces::do_last(const SharedWork& work) {
  const std::size_t last = pieces_.size() - 1;
  const auto begin = std::chrono::steady_clock::now();
  put(last, work.piece(last));
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  double others = 0.0;
  for (std::size_t i = 0; i < last; ++i) others += work.numbers_of_piece(i);
  return taken.count() * (others / std::max(1.0, static_cast<double>(work.numbers_of_piece(last))));
}

std::vector<std::vector<double>> SharedPieces::do_rest(const SharedWork& work) {
  in_pieces(pieces_.size(), [&](std::size_t i) {
    const std::size_t piece = pieces_.size() - 1 - i;
    if (!is_done(piece)) put(piece, work.piece(piece));
  });
  const std::lock_guard lock(mutex_);
  std::vector<std::vector<double>> all;
  for (const auto& numbers : pieces_) all.push_back(*numbers);
  return all;
}

}  // namespace demecal::inline scheduling
