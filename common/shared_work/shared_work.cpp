#include "shared_work/shared_work.hpp"

#include "pieces/pieces.hpp"
#include "shared_work/agreement_draws.hpp"
#include "shared_work/candidate_products.hpp"
#include "shared_work/gain_draws.hpp"
#include "shared_work/resamplings.hpp"
#include "shared_work/work_tables.hpp"

namespace demecal::inline shared_work {
namespace {

std::unique_ptr<SharedWork> read_work(const WorkInputs& inputs) {
  WorkReader reader(inputs);
  std::unique_ptr<SharedWork> work;
  if (inputs.kind == WorkKind::agreements) work = AgreementDraws::read(reader);
  if (inputs.kind == WorkKind::gains) work = GainDraws::read(reader);
  if (inputs.kind == WorkKind::resamplings) work = Resamplings::read(reader);
  if (inputs.kind == WorkKind::products) work = CandidateProducts::read(reader);
  WorkReader::require(work != nullptr, "work of an unknown kind");
  WorkReader::require(reader.lists_left() == 0 && reader.tables_left() == 0, "lists or tables too many");
  reader.require_pieces_of(*work);
  return work;
}

}  // namespace

WorkInputs SharedWork::empty_inputs(WorkKind kind, std::uint64_t stream) const {
  WorkInputs inputs{kind, {}, stream, {}, {}};
  for (std::size_t i = 0; i < pieces(); ++i) inputs.numbers_of_pieces.push_back(numbers_of_piece(i));
  return inputs;
}

std::vector<std::vector<double>> do_work(const SharedWork& work) {
  std::vector<std::vector<double>> done(work.pieces());
  in_pieces(done.size(), [&](std::size_t i) { done[i] = work.piece(i); });
  return done;
}

std::optional<std::string> find_fault(const WorkInputs& inputs) {
  try {
    read_work(inputs);
    return std::nullopt;
  } catch (const WorkFault& fault) {
    return fault.text;
  }
}

std::unique_ptr<SharedWork> received_work(const WorkInputs& inputs) {
  return read_work(inputs);
}

}  // namespace demecal::inline shared_work
