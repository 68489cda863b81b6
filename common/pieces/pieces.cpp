#include "pieces/pieces.hpp"

#include <utility>

namespace demecal::inline pieces {
namespace {

thread_local PieceRunner* runner_of_thread = nullptr;

}  // namespace

void in_pieces(std::size_t count, const Piece& piece) {
  if (runner_of_thread != nullptr && count > 1) return runner_of_thread->run(count, piece);
  for (std::size_t i = 0; i < count; ++i) piece(i);
}

RunPiecesBy::RunPiecesBy(PieceRunner& runner) : before_(std::exchange(runner_of_thread, &runner)) {}

RunPiecesBy::~RunPiecesBy() {
  runner_of_thread = before_;
}

}  // namespace demecal::inline pieces
