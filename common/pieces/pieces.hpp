// Work in independent pieces: one after another or, where the calling thread has a runner, several at once.
#pragma once

#include <cstddef>
#include <functional>

namespace demecal::inline pieces {

using Piece = std::function<void(std::size_t number)>;

/// Runs pieces for one thread.
class PieceRunner {
 public:
  virtual ~PieceRunner() = default;
  /// Calls piece(0) to piece(count - 1), each once, in any order; returns when all have ended. What the first of them
  /// by number threw is thrown on.
  virtual void run(std::size_t count, const Piece& piece) = 0;
};

/// The same by the runner of the calling thread, or in order where it has none. No result may depend on the order, so
/// that there are the same bits however many run at once: pieces write to places of their own.
void in_pieces(std::size_t count, const Piece& piece);

/// The same for what is quick: a hundred to a piece.
void in_batches(std::size_t count, const Piece& each);

/// While it lives, the calling thread's pieces are run by `runner`, which has to live as long.
class RunPiecesBy {
 public:
  explicit RunPiecesBy(PieceRunner& runner);
  ~RunPiecesBy();
  RunPiecesBy(const RunPiecesBy&) = delete;
  RunPiecesBy& operator=(const RunPiecesBy&) = delete;

 private:
  PieceRunner* before_;
};

}  // namespace demecal::inline pieces
