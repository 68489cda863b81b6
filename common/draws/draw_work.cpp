#include "draws/draw_work.hpp"

#include <algorithm>

#include "draws/agreement_draws.hpp"
#include "draws/draw_tables.hpp"
#include "draws/gain_draws.hpp"
#include "pieces/pieces.hpp"

namespace demecal::inline draws {
namespace {

constexpr std::uint32_t kDrawsOfPiece = 32;
constexpr std::uint32_t kMostDrawsOfWork = 32'768, kMostNumbersOfDraw = 100'000;

std::size_t pieces_of(std::uint32_t draws) {
  return (std::size_t{draws} + kDrawsOfPiece - 1) / kDrawsOfPiece;
}

std::uint32_t draws_in_piece(std::uint32_t draws, std::size_t number) {
  return std::min(kDrawsOfPiece, draws - static_cast<std::uint32_t>(number) * kDrawsOfPiece);
}

std::unique_ptr<DrawWork> read_work(const DrawInputs& inputs) {
  DrawReader::require(inputs.draws > 0 && inputs.draws <= kMostDrawsOfWork, "no draws, or too many");
  DrawReader::require(inputs.numbers_of_draw <= kMostNumbersOfDraw, "too many numbers of a draw");
  DrawReader reader(inputs);
  std::unique_ptr<DrawWork> work;
  if (inputs.kind == DrawKind::agreements) work = AgreementDraws::read(inputs, reader);
  if (inputs.kind == DrawKind::gains) work = GainDraws::read(inputs, reader);
  DrawReader::require(work != nullptr, "draws of an unknown kind");
  DrawReader::require(reader.lists_left() == 0 && reader.tables_left() == 0, "lists or tables too many");
  DrawReader::require(work->numbers_of_draw() == inputs.numbers_of_draw, "numbers_of_draw is not what the tables give");
  return work;
}

}  // namespace

std::size_t DrawInputs::pieces() const {
  return pieces_of(draws);
}

std::size_t DrawInputs::numbers_of_piece(std::size_t piece) const {
  return std::size_t{draws_in_piece(draws, piece)} * numbers_of_draw;
}

std::size_t DrawWork::pieces() const {
  return pieces_of(draws_);
}

std::uint32_t DrawWork::draws_of_piece(std::size_t number) const {
  return draws_in_piece(draws_, number);
}

std::vector<std::vector<double>> make_draws(const DrawWork& work) {
  std::vector<std::vector<double>> drawn(work.pieces());
  in_pieces(drawn.size(), [&](std::size_t i) { drawn[i] = work.piece(i); });
  return drawn;
}

std::optional<std::string> find_fault(const DrawInputs& inputs) {
  try {
    read_work(inputs);
    return std::nullopt;
  } catch (const DrawFault& fault) {
    return fault.text;
  }
}

std::unique_ptr<DrawWork> draw_work(const DrawInputs& inputs) {
  return read_work(inputs);
}

}  // namespace demecal::inline draws
