// Work of many random draws, so many a piece.
#pragma once

#include <cstddef>
#include <cstdint>

#include "random/random_stream.hpp"
#include "shared_work/shared_work.hpp"
#include "shared_work/work_tables.hpp"

namespace demecal::inline shared_work {

/// Piece i draws from the stream {stream, i}; the last may be of fewer draws.
struct DrawCount {
  std::uint32_t draws = 0;
  std::uint64_t stream = 0;
  std::uint32_t of_piece = 32;
};

class RandomDraws : public SharedWork {
 public:
  explicit RandomDraws(const DrawCount& count) : count_(count) {}

  /// Each gives as many, one draw after another.
  virtual std::uint32_t numbers_of_draw() const = 0;
  std::size_t pieces() const override;
  std::uint32_t numbers_of_piece(std::size_t number) const override;

 protected:
  std::uint32_t draws_of_piece(std::size_t number) const;
  RandomStream random_of_piece(std::size_t number) const { return RandomStream{count_.stream, number}; }
  /// With one list: how many draws there are, and how many are a piece.
  WorkInputs counted_inputs(WorkKind kind) const;

 private:
  DrawCount count_;
};

/// That list, and the stream.
DrawCount read_draw_count(WorkReader& reader);

}  // namespace demecal::inline shared_work
