// Work of many random draws, in pieces that any process can make from the same inputs, to the bit.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace demecal::inline draws {

/// What is made of each draw: how far errors of neighbours agree (AgreementDraws), or what the best candidate would
/// explain (GainDraws).
enum class DrawKind { agreements, gains };

/// A matrix as it travels.
struct DrawTable {
  std::uint32_t rows = 0;
  std::vector<double> numbers;  ///< column by column

  bool operator==(const DrawTable&) const = default;
};

/// All that draws are made from, as plain numbers that travel. The kind says what stands in which list and table.
struct DrawInputs {
  DrawKind kind = DrawKind::agreements;
  std::uint32_t draws = 0;
  std::uint32_t numbers_of_draw = 0;  ///< that each gives
  std::uint64_t stream = 0;           ///< names their random numbers
  std::vector<std::vector<std::uint32_t>> lists;
  std::vector<DrawTable> tables;

  std::size_t pieces() const;
  /// That a piece gives.
  std::size_t numbers_of_piece(std::size_t piece) const;

  bool operator==(const DrawInputs&) const = default;
};

class DrawWork {
 public:
  DrawWork(std::uint32_t draws, std::uint64_t stream) : draws_(draws), stream_(stream) {}
  virtual ~DrawWork() = default;

  std::uint32_t draws() const { return draws_; }
  std::uint64_t stream() const { return stream_; }
  std::size_t pieces() const;
  /// numbers_of_draw() of each of its draws, one draw after another. From any thread.
  virtual std::vector<double> piece(std::size_t number) const = 0;
  virtual std::uint32_t numbers_of_draw() const = 0;
  /// From which draw_work() makes work of the same pieces.
  virtual DrawInputs inputs() const = 0;

 protected:
  std::uint32_t draws_of_piece(std::size_t number) const;

 private:
  std::uint32_t draws_;
  std::uint64_t stream_;
};

/// Makes all pieces of a work, in order.
using MakeDraws = std::function<std::vector<std::vector<double>>(const DrawWork&)>;

/// Here, as independent pieces of work.
std::vector<std::vector<double>> make_draws(const DrawWork& work);

/// Why no work can be made of received numbers; nothing where it can.
std::optional<std::string> find_fault(const DrawInputs& inputs);

/// The work of inputs that have no fault.
std::unique_ptr<DrawWork> draw_work(const DrawInputs& inputs);

}  // namespace demecal::inline draws
