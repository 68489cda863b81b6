#include "diagnosis/scan.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <string>

#include "decompositions/decompositions.hpp"
#include "effects/effect.hpp"
#include "expression/tree.hpp"
#include "pieces/pieces.hpp"
#include "primitives/primitive.hpp"
#include "products/tall_products.hpp"
#include "residuals/found_noise.hpp"
#include "shared_work/gain_draws.hpp"

namespace demecal::inline diagnosis {
namespace {

constexpr double kRivalCosine = 0.9;
constexpr double kRelated = 0.5;
constexpr double kRivalNats = 5.0;
constexpr std::size_t kMostRivals = 8;

/// Whether `other` is the wave `named` with a phase that is not given: the same formula, no rival.
bool is_its_wave(const Effect& named, const Effect& other) {
  if (named.joint != other.joint || other.form != "wave" || named.formula.empty()) return false;
  const Primitive root = named.formula[0].primitive;
  return (root == Primitive::sine || root == Primitive::cosine) &&
         std::equal(named.formula.begin() + 1, named.formula.end(), other.formula.begin(), other.formula.end());
}

}  // namespace

ModelPart part_of_model(const Eigen::MatrixXd& to_basis, const Eigen::VectorXd& values) {
  // With the covariance C of the numbers these are the directions of their inverse's root; what they explain is C^-1/2
  // times the values.
  const Eigen::MatrixXd covariance = to_basis * to_basis.transpose();
  Eigen::VectorXd scale = covariance.diagonal().cwiseSqrt();
  for (double& value : scale) value = value > 0.0 ? 1.0 / value : 0.0;
  const auto eigen = eigen_system(scale.asDiagonal() * covariance * scale.asDiagonal());
  Eigen::MatrixXd turn(values.size(), values.size());
  Eigen::Index rank = 0;
  for (Eigen::Index i = 0; i < values.size(); ++i)
    if (eigen.values[i] > kNewShare)
      turn.col(rank++) = scale.cwiseProduct(eigen.vectors.col(i)) / std::sqrt(eigen.values[i]);
  return {to_basis.transpose() * turn.leftCols(rank), turn.leftCols(rank).transpose() * values};
}

Scan::Scan(const EffectColumns& columns, const std::vector<double>& naming_costs_nats, const ResidualField& field,
           const Projection& model, const DoWork& do_work)
    : spans_(columns.spans()),
      naming_costs_nats_(naming_costs_nats),
      whole_(columns.squares(field)),
      prices_{static_cast<double>(field.rows()), static_cast<double>(distinct_poses(field))} {
  RowMatrix basis_and_residual(field.rows(), model.rank() + 1);
  basis_and_residual.leftCols(model.rank()) = model.basis();
  basis_and_residual.col(model.rank()) = model.residual();
  const Eigen::MatrixXd products = columns.transposed_times(field, basis_and_residual, do_work);
  along_ = products.leftCols(model.rank());
  moment_ = products.col(model.rank());
  squares_ = model.squares();
  invert();
}

void Scan::follow(const Eigen::MatrixXd& products, const Projection::Trial& trial, const Projection& model) {
  along_.conservativeResize(Eigen::NoChange, model.rank());
  along_.rightCols(trial.rank) = products;
  moment_ -= products * trial.along;
  squares_ = model.squares();
  invert();
}

/// Of a candidate's columns beyond a model: `left` is their Gram matrix, `lengths` the squares of whole columns.
Scan::Gram Scan::inverted(const Eigen::MatrixXd& left, const Eigen::VectorXd& lengths) {
  Gram gram;
  Eigen::VectorXd scale = lengths.cwiseSqrt();
  for (double& value : scale) value = value > kNoColumn ? 1 / value : 0.0;
  const auto eigen = eigen_system(scale.asDiagonal() * left * scale.asDiagonal());
  Eigen::VectorXd inverse = eigen.values;
  for (double& value : inverse) {
    gram.rank += value > kNewShare;
    value = value > kNewShare ? 1 / value : 0.0;
  }
  const Eigen::MatrixXd turned = scale.asDiagonal() * eigen.vectors;
  gram.inverse = turned * inverse.asDiagonal() * turned.transpose();
  gram.visible = left.diagonal().cwiseMax(0.0);
  if (gram.rank == 0) gram.visible.setZero();
  return gram;
}

void Scan::invert() {
  grams_.assign(spans_.size(), {});
  in_pieces(spans_.size(), [&](std::size_t i) {
    const auto along = along_.middleRows(spans_[i].first, spans_[i].count);
    grams_[i] = inverted(whole_[i] - along * along.transpose(), whole_[i].diagonal());
  });
}

double Scan::gain_nats(const ModelPart& part, double naming_cost_nats) const {
  const double drop = part.explained.squaredNorm();
  return prices_.gain_nats(drop, squares_ + drop, part.explained.size(), naming_cost_nats);
}

Scan::InPlace Scan::in_place_of(const ModelPart& part) const {
  InPlace all{std::vector<double>(spans_.size(), 0.0), std::vector<double>(spans_.size(), 0.0)};
  const double square = part.explained.squaredNorm();
  for (std::size_t i = 0; i < spans_.size() && square > 0.0; ++i) {
    const auto along = along_.middleRows(spans_[i].first, spans_[i].count);
    const Eigen::MatrixXd own = along * part.directions;
    const Gram gram = inverted(whole_[i] - along * along.transpose() + own * own.transpose(), whole_[i].diagonal());
    const Eigen::VectorXd shared = own * part.explained;
    const Eigen::VectorXd moment = moment_.segment(spans_[i].first, spans_[i].count) + shared;
    all.cosines[i] = std::sqrt(std::clamp(shared.dot(gram.inverse * shared) / square, 0.0, 1.0));
    all.gains_nats[i] =
        prices_.gain_nats(moment.dot(gram.inverse * moment), squares_ + square, gram.rank, naming_costs_nats_[i]);
  }
  return all;
}

std::vector<Score> Scan::scores() const {
  std::vector<Score> scores(spans_.size());
  for (std::size_t i = 0; i < spans_.size(); ++i) {
    const auto moment = moment_.segment(spans_[i].first, spans_[i].count);
    scores[i].drop = moment.dot(grams_[i].inverse * moment);
    scores[i].rank = grams_[i].rank;
    scores[i].visible = grams_[i].visible;
    scores[i].gain_nats = prices_.gain_nats(scores[i].drop, squares_, scores[i].rank, naming_costs_nats_[i]);
  }
  return scores;
}

std::vector<double> Scan::cosines(const Eigen::MatrixXd& products, double square) const {
  std::vector<double> cosines(spans_.size(), 0.0);
  for (std::size_t i = 0; i < spans_.size() && square > 0; ++i) {
    const auto moment = products.col(0).segment(spans_[i].first, spans_[i].count);
    cosines[i] = std::sqrt(std::clamp(moment.dot(grams_[i].inverse * moment) / square, 0.0, 1.0));
  }
  return cosines;
}

std::vector<double> Scan::null_maxima(const EffectColumns& columns, const ResidualField& field, const Projection& model,
                                      int count, RandomStream random, const DoWork& make) const {
  std::vector<GainCandidate> candidates;
  for (std::size_t i = 0; i < spans_.size(); ++i)
    candidates.push_back({spans_[i].first, grams_[i].rank, naming_costs_nats_[i], grams_[i].inverse});
  const GainDraws work({.noise = null_noise(field, model),
                        .basis = model.basis().cast<float>(),
                        .prior_basis = model.prior_basis().cast<float>(),
                        .along = along_.cast<float>(),
                        .candidates = std::move(candidates),
                        .prices = prices_},
                       columns.blocks(), field.motions, DrawCount{static_cast<std::uint32_t>(count), random.name()});
  std::vector<double> maxima;
  for (const std::vector<double>& piece : make(work)) std::ranges::copy(piece, std::back_inserter(maxima));
  std::sort(maxima.begin(), maxima.end());
  return maxima;
}

bool is_rival(const Effect& named, const Effect& other, double cosine, double nats_behind) {
  if (is_symbolic(other) && !is_symbolic(named)) return false;  // a name is preferred to a formula
  if (is_its_wave(named, other)) return false;
  return cosine > kRivalCosine || (cosine > kRelated && std::abs(nats_behind) < kRivalNats);
}

void keep_nearest(std::vector<Rival>& rivals) {
  std::ranges::stable_sort(rivals, std::greater{}, &Rival::cosine);
  if (rivals.size() > kMostRivals) rivals.resize(kMostRivals);
}

std::vector<Rival> rivals_of(std::size_t named, const Projection::Trial& explained, const Eigen::MatrixXd& products,
                             const std::vector<Candidate>& all, const std::vector<Score>& scores, const Scan& scan) {
  // What is believed has its share: where poses share errors it is the larger part.
  const double square = (explained.fitted * explained.coefficients).squaredNorm() +
                        (explained.prior * explained.coefficients).squaredNorm();
  const std::vector<double> cosines = scan.cosines(products * explained.along, square);
  std::vector<Rival> rivals;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i == named || all[i].decoy_kind != DecoyKind::none) continue;
    const double behind = scores[named].gain_nats - scores[i].gain_nats;
    if (is_rival(all[named].effect, all[i].effect, cosines[i], behind))
      rivals.push_back({all[i].effect, cosines[i], behind});
  }
  keep_nearest(rivals);
  return rivals;
}

std::vector<Rival> rivals_of_held(const Effect& held, const ModelPart& part, const std::vector<Candidate>& all,
                                  const Scan& scan) {
  const Scan::InPlace others = scan.in_place_of(part);
  const double own_nats = scan.gain_nats(part, naming_cost_nats(held, all));
  std::vector<Rival> rivals;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].decoy_kind != DecoyKind::none || all[i].effect.same_law_as(held)) continue;
    const double behind = own_nats - others.gains_nats[i];
    if (is_rival(held, all[i].effect, others.cosines[i], behind))
      rivals.push_back({all[i].effect, others.cosines[i], behind});
  }
  keep_nearest(rivals);
  return rivals;
}

void exclude_own_forms(std::vector<Round>& rounds) {
  for (Round& round : rounds) {
    std::erase_if(round.rivals, [&](const Rival& rival) {
      const Effect &own = round.effect, &other = rival.effect;
      const bool named = !is_symbolic(own) && own.kind == other.kind && own.joint == other.joint;
      return other.same_law_as(own) || (named && other.settings == own.settings);
    });
  }
}

}  // namespace demecal::inline diagnosis
