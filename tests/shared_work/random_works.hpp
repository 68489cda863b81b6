// Work of every kind from random numbers.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "random/random_stream.hpp"
#include "shared_work/agreement_draws.hpp"
#include "shared_work/candidate_products.hpp"
#include "shared_work/gain_draws.hpp"
#include "shared_work/null_noise.hpp"
#include "shared_work/resamplings.hpp"

namespace demecal {

class RandomWorks {
 public:
  explicit RandomWorks(std::uint64_t seed) : random_{97, seed} {}

  /// Some poses are silent, some beliefs are none.
  NullNoise noise() {
    NullNoise noise{{0}, {}, {}, {}, {}};
    for (int pose = 0; pose < 24; ++pose) {
      const Eigen::Index rows = random_.chance(0.7) ? 3 : 6;
      noise.first_row.push_back(noise.first_row.back() + rows);
      noise.silent.push_back(random_.chance(0.1));
      if (!noise.silent.back()) noise.lengths[rows].push_back(random_.real(0.5, 2.0));
    }
    for (int belief = 0; belief < 4; ++belief) noise.believed.push_back(random_.chance(0.5));
    noise.belief_deviations = Eigen::VectorXd::Constant(4, 0.7);
    return noise;
  }

  /// `of_others`: as where the poses that are not drawn are drawn as one.
  AgreementDraws agreements(bool of_others, std::uint32_t draws = 70) {
    NullResiduals residuals{noise(), {}, {}, matrix(4, 5), {}, 30.0};
    for (std::size_t pose = 0; pose < residuals.noise.poses(); ++pose)
      if (random_.chance(0.6)) residuals.poses.push_back(pose);
    const auto rows = static_cast<Eigen::Index>(residuals.rows().size());
    residuals.basis = 0.1 * matrix(of_others ? rows : residuals.noise.rows(), 5);
    if (of_others) residuals.others_root = matrix(5, 3);
    std::vector<Pairs> circumstances(3);
    for (Pairs& pairs : circumstances)
      for (int pair = 0; pair < 20; ++pair)
        pairs.push_back({random_.index(residuals.poses.size()), random_.index(residuals.poses.size())});
    const auto poses = static_cast<Eigen::Index>(residuals.poses.size());
    RowMatrix lengths = matrix(poses, 2).cwiseAbs();
    lengths(0, 0) = 0.0;  // a joint that does not move that pose
    return {std::move(residuals), matrix(rows, 2), std::move(lengths), std::move(circumstances), {draws, 5}};
  }

  /// With what they refer to.
  struct Gains {
    std::vector<FeatureBlock> blocks;
    RowMatrix motions;
    std::unique_ptr<GainDraws> work;
  };
  struct Products {
    std::vector<FeatureBlock> blocks;
    std::vector<Eigen::Index> first_row;
    RowMatrix motions, rows;
    std::unique_ptr<CandidateProducts> work;
  };
  std::unique_ptr<Gains> gains(std::uint32_t draws = 70) {
    auto made = std::make_unique<Gains>();
    GainDraws::Parts parts{noise(), {}, (0.1 * matrix(4, 5)).cast<float>(), (0.1 * matrix(6, 5)).cast<float>(), {}, {}};
    const auto poses = static_cast<Eigen::Index>(parts.noise.poses());
    parts.basis = (0.1 * matrix(parts.noise.rows(), 5)).cast<float>();
    parts.candidates = {{0, 1, 2.0, matrix(2, 2).cwiseAbs()}, {2, 0, 1.0, matrix(1, 1)}, {3, 3, 0.5, matrix(3, 3)}};
    parts.prices = {static_cast<double>(parts.noise.rows()), static_cast<double>(poses)};
    made->blocks = {{1, {0, 1, 4}, matrix(poses, 3)}, {0, {2, 3, 4, 5}, matrix(poses, 4)}};
    made->motions = matrix(parts.noise.rows(), 3);
    made->work = std::make_unique<GainDraws>(std::move(parts), made->blocks, made->motions, DrawCount{draws, 6});
    return made;
  }

  Resamplings resamplings(std::uint32_t draws = 70) { return {matrix(6, 24), {draws, 7, 50}}; }

  std::unique_ptr<Products> products(Eigen::Index blocks = 2) {
    auto made = std::make_unique<Products>();
    made->first_row = noise().first_row;
    const auto poses = static_cast<Eigen::Index>(made->first_row.size()) - 1;
    for (Eigen::Index i = 0; i < blocks; ++i)
      made->blocks.push_back({i, {2 * i, 2 * i + 1, 2 * i + 3}, matrix(poses, 3)});
    made->motions = matrix(made->first_row.back(), blocks);
    made->rows = matrix(made->first_row.back(), 5);
    made->work = std::make_unique<CandidateProducts>(made->blocks, made->first_row, made->motions, made->rows);
    return made;
  }

 private:
  RowMatrix matrix(Eigen::Index rows, Eigen::Index columns) {
    RowMatrix numbers(rows, columns);
    for (double& number : numbers.reshaped()) number = random_.normal();
    return numbers;
  }

  RandomStream random_;
};

inline std::vector<WorkInputs> inputs_of_all_kinds(std::uint64_t seed) {
  RandomWorks works(seed);
  return {works.agreements(false).inputs(), works.agreements(true).inputs(), works.gains()->work->inputs(),
          works.resamplings().inputs(), works.products()->work->inputs()};
}

}  // namespace demecal
