// How far the numbers of one robot drift between two measurements, as its models of several dates tell.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "updating/fleet_model.hpp"
#include "updating/prior_model.hpp"

namespace demecal::inline updating {

/// Throws InputError, naming the file: at models of other arms, of fleets, of the same data and without a posterior,
/// and where the first, which is to be brought up to date, states an earlier date of measurement than another.
void require_models_of_one_robot(const std::vector<NamedModel>& models);

struct LearnedDrift {
  AssumedDrift drift;
  std::string sentence;
};

/// Of what AssumedDrift states for each kind, what makes these models of one robot likeliest (restricted likelihood;
/// each knows its numbers as its posterior says). What is stated counts as much as four numbers of each kind besides, a
/// kind of which the models know nothing and ripples stay as stated. Effects count that all models have; `poses` of
/// `data` say how far these move the arm. Two models at least.
LearnedDrift learned_drift(const std::vector<NamedModel>& models, const DataSet& data,
                           std::span<const std::size_t> poses);

}  // namespace demecal::inline updating
