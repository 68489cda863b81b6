// Brings an evolved formula into the form that people write: constants at their least-squares values, round where the
// data allow it.
#pragma once

#include "evolution/fitness.hpp"

namespace demecal {

/// `tree` with its constants (the first 8) where the weighted sum of squares over the table is least, the formula's
/// amplitude free: Levenberg and Marquardt's steps from where they are. Then, one after another, a constant within 0.15
/// of a whole or half number is put there where the others, fitted again, make up for it but for 1 nat of likelihood.
/// The tree must be finite on the table.
Tree polished(const Tree& tree, const TrainingTable& table);

/// The length of a formula's description, nats: every node names one of the primitives and variables, every constant
/// that is not a whole or half number costs half the log of the number of rows.
double description_nats(const Tree& tree, int variables, std::size_t rows);

}  // namespace demecal
