// Work in pieces that any process can do from the same inputs, to the bit.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace demecal::inline shared_work {

/// How far errors of neighbours agree in draws of noise (AgreementDraws); what the best candidate would explain of such
/// draws (GainDraws); what columns add up to in resamplings (Resamplings); products of candidates' columns
/// (CandidateProducts).
enum class WorkKind { agreements, gains, resamplings, products };

/// A matrix as it travels.
struct WorkTable {
  std::uint32_t rows = 0;
  std::vector<double> numbers;  ///< column by column

  bool operator==(const WorkTable&) const = default;
};

/// All that work is done from, as plain numbers that travel. The kind says what stands in which list and table.
struct WorkInputs {
  WorkKind kind = WorkKind::agreements;
  std::vector<std::uint32_t> numbers_of_pieces;  ///< how many each gives
  std::uint64_t stream = 0;                      ///< names random numbers, where any are drawn
  std::vector<std::vector<std::uint32_t>> lists;
  std::vector<WorkTable> tables;

  bool operator==(const WorkInputs&) const = default;
};

class SharedWork {
 public:
  virtual ~SharedWork() = default;

  virtual std::size_t pieces() const = 0;
  /// That it gives. In proportion to the time that it takes.
  virtual std::uint32_t numbers_of_piece(std::size_t number) const = 0;
  /// From any thread.
  virtual std::vector<double> piece(std::size_t number) const = 0;
  /// From which received_work() makes work of the same pieces.
  virtual WorkInputs inputs() const = 0;

 protected:
  /// Without lists and tables.
  WorkInputs empty_inputs(WorkKind kind, std::uint64_t stream) const;
};

/// Does all pieces of a work, in order.
using DoWork = std::function<std::vector<std::vector<double>>(const SharedWork&)>;

/// Here, as independent pieces of work.
std::vector<std::vector<double>> do_work(const SharedWork& work);

/// Why received numbers are of no work; nothing where they are.
std::optional<std::string> find_fault(const WorkInputs& inputs);

/// The work of inputs that have no fault.
std::unique_ptr<SharedWork> received_work(const WorkInputs& inputs);

}  // namespace demecal::inline shared_work
