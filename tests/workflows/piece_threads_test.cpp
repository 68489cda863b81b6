// Pieces of work: each is done once, whoever runs them, and what they throw is thrown on.
#include "workflows/piece_threads.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "explanations/explanation_search.hpp"

namespace demecal {
namespace {

std::vector<int> counts_of(std::size_t pieces) {
  std::vector<int> counts(pieces, 0);
  in_pieces(pieces, [&](std::size_t i) { ++counts[i]; });
  return counts;
}

TEST(Pieces, AreEachDoneOnceWhoeverRunsThem) {
  EXPECT_EQ(counts_of(50), std::vector<int>(50, 1));
  for (const unsigned number : {0U, 1U, 2U, 7U}) {
    PieceThreads threads(number);
    const RunPiecesBy by(threads);
    for (std::size_t pieces = 0; pieces < 300; ++pieces) EXPECT_EQ(counts_of(pieces), std::vector<int>(pieces, 1));
  }
}

TEST(Pieces, RunAtOnceWhereThereAreThreads) {
  PieceThreads threads(2);
  const RunPiecesBy by(threads);
  std::atomic<int> arrived{0};
  in_pieces(2, [&](std::size_t) {  // would wait forever in one thread
    ++arrived;
    while (arrived < 2) std::this_thread::yield();
  });
  EXPECT_EQ(arrived, 2);
}

TEST(Pieces, WithinPiecesAreDoneInTheThreadOfTheOuterOne) {
  PieceThreads threads(3);
  const RunPiecesBy by(threads);
  std::vector<int> sums(20, 0);
  in_pieces(sums.size(), [&](std::size_t i) {
    const auto caller = std::this_thread::get_id();
    std::vector<std::size_t> inner(30, 0);
    in_pieces(inner.size(), [&](std::size_t j) {
      if (std::this_thread::get_id() == caller) inner[j] = j;
    });
    sums[i] = static_cast<int>(std::accumulate(inner.begin(), inner.end(), std::size_t{0}));
  });
  EXPECT_EQ(sums, std::vector<int>(20, 435));
}

TEST(Pieces, WithinAPieceWaitForNoOtherPiece) {
  PieceThreads threads(2);
  const RunPiecesBy by(threads);
  std::atomic<int> arrived{0};
  std::atomic<bool> met{true};
  in_pieces(2, [&](std::size_t) {
    in_pieces(3, [](std::size_t) {});
    ++arrived;
    const auto latest = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (arrived < 2 && std::chrono::steady_clock::now() < latest) std::this_thread::yield();
    if (arrived < 2) met = false;
  });
  EXPECT_TRUE(met);
}

TEST(Pieces, ThrowOnWhatTheFirstByNumberThrew) {
  for (const unsigned number : {1U, 4U}) {
    PieceThreads threads(number);
    const RunPiecesBy by(threads);
    for (int repeat = 0; repeat < 50; ++repeat) {
      std::string what;
      try {
        in_pieces(40, [](std::size_t i) {
          if (i % 7 == 3) throw std::runtime_error(std::to_string(i));
        });
      } catch (const std::runtime_error& fault) {
        what = fault.what();
      }
      EXPECT_EQ(what, "3");
    }
  }
}

TEST(Pieces, GiveTheSameExplanationsHoweverManyRunAtOnce) {
  ExplanationProblem problem;
  RandomStream random{5};
  Eigen::MatrixXd columns(60, 24);
  for (double& value : columns.reshaped()) value = random.normal();
  columns.colwise().normalize();
  const Eigen::VectorXd residual = 9.0 * columns.col(3) - 6.0 * columns.col(8) + 5.0 * columns.col(20);
  problem.gram = columns.transpose() * columns + 1e-3 * Eigen::MatrixXd::Identity(24, 24);
  problem.moment = columns.transpose() * residual;
  problem.squares = residual.squaredNorm() + 60.0;
  problem.rows = problem.freedom = problem.poses = 60.0;
  for (std::size_t i = 0; i < 24; ++i) {
    problem.spans.push_back({static_cast<Eigen::Index>(i), 1});
    problem.naming_costs_nats.push_back(1.0);
    problem.cause.push_back(i / 4);
  }
  const auto searched = [&] {
    return search_explanations(problem, set_search({3}, {.variations = 400}, RandomStream{6}));
  };
  const std::vector<EffectSet> alone = searched();
  EXPECT_GT(alone.size(), 2u);
  for (const unsigned number : {2U, 3U, 8U}) {
    PieceThreads threads(number);
    const RunPiecesBy by(threads);
    const std::vector<EffectSet> together = searched();
    ASSERT_EQ(together.size(), alone.size());
    for (std::size_t i = 0; i < alone.size(); ++i) {
      EXPECT_EQ(together[i].effects, alone[i].effects);
      EXPECT_EQ(together[i].description_nats, alone[i].description_nats);
    }
  }
}

}  // namespace
}  // namespace demecal
