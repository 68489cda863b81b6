// Faults of single poses, as people and instruments make them.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "noise_case.hpp"
#include "random/random_stream.hpp"

namespace demecal::bench {

/// Puts the fault into poses of `among` (indices into the data set) at random and returns the ids of those it is in.
/// Exchanged: the measured points of two poses that lie more than 50 mm apart. Typing: one joint of one pose, by two
/// neighbouring digits exchanged (of its value in deg with two decimals), a wrong sign or 10 deg, such that the nominal
/// tool point moves by 1 mm at least. Gross: errors of the points of 2 % of the poses, 1 mm to 1 m with equal chances
/// for every decade.
std::vector<std::string> put_fault(Fault fault, DataSet& data, std::span<const std::size_t> among,
                                   RandomStream& random);

/// The value with two neighbouring, different digits exchanged, chosen at random; itself where all digits are equal.
double with_digits_exchanged(double angle_rad, RandomStream& random);

}  // namespace demecal::bench
