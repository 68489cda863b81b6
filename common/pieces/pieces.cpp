#include "pieces/pieces.hpp"

#include <algorithm>
#include <utility>

namespace demecal::inline pieces {
namespace {

thread_local PieceRunner* runner_of_thread = nullptr;

/// While it lives, the calling thread's pieces are done in order.
class InOrder {
 public:
  InOrder() : before_(std::exchange(runner_of_thread, nullptr)) {}
  ~InOrder() { runner_of_thread = before_; }
  InOrder(const InOrder&) = delete;
  InOrder& operator=(const InOrder&) = delete;

 private:
  PieceRunner* before_;
};

}  // namespace

void in_pieces(std::size_t count, const Piece& piece) {
  if (runner_of_thread != nullptr && count > 1) {
    PieceRunner& runner = *runner_of_thread;
    // Pieces of a piece would wait until those who help with the outer ones have ended them all.
    const InOrder within;
    return runner.run(count, piece);
  }
  for (std::size_t i = 0; i < count; ++i) piece(i);
}

void in_batches(std::size_t count, const Piece& each) {
  constexpr std::size_t kAtATime = 100;
  in_pieces((count + kAtATime - 1) / kAtATime, [&](std::size_t batch) {
    const std::size_t end = std::min((batch + 1) * kAtATime, count);
    for (std::size_t i = batch * kAtATime; i < end; ++i) each(i);
  });
}

RunPiecesBy::RunPiecesBy(PieceRunner& runner) : before_(std::exchange(runner_of_thread, &runner)) {}

RunPiecesBy::~RunPiecesBy() {
  runner_of_thread = before_;
}

}  // namespace demecal::inline pieces
