// The Denavit-Hartenberg matrices of an arm as text, with its numbers or with a name for each parameter.
#pragma once

#include <string>
#include <vector>

#include "kinematics/chain.hpp"
#include "symbolic/parse_expression.hpp"

namespace demecal::inline prediction {

enum class LinkNumbers {
  given,  ///< parameters are written as numbers, m and rad
  named   ///< as theta1, d1, a1, alpha1, beta1 and so on
};

/// "theta2": a link parameter's name; joints count from 0.
std::string parameter_name(LinkParameter parameter, int joint);

/// The matrices whose product is the flange's pose at joints q1 .. qn, in their order, without what stands before
/// and behind the links (Chain::base, Chain::flange): one a link, and where a link has
/// (given) or may have (named) Hayati's beta, its parts. Rows as in thesis table 5-4.
std::vector<MatrixText> link_texts(const Chain& chain, LinkNumbers numbers);

}  // namespace demecal::inline prediction
