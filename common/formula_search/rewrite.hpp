// Brings an evolved formula into the form that people write: step by step as long as its description grows shorter,
// with constants at their least-squares values, round where the data allow it.
#pragma once

#include "expression/tree.hpp"
#include "formula_search/misfit.hpp"

namespace demecal::inline formula_search {

/// `tree` with its constants (the first 8) where the misfit's sum of squares is least, the formula's amplitude free:
/// Levenberg and Marquardt's steps from where they are. Then, one after another, a constant within 0.15 of a whole or
/// half number is put there where the others, fitted again, make up for it but for what its digits would cost (see
/// description_nats). The tree must be finite at all poses.
Tree polished(const Tree& tree, FormulaMisfit& misfit);

/// Where the steepest descent of misfit and description together (nats) ends that begins at `tree`. In each step a part
/// gives way to one of its own parts, to 1 or, where it depends on one variable, to that variable, its sine or cosine;
/// or, in formulas of less than 20 nodes, a variable to its double or to its sum or difference with another, or the
/// whole to its product with a variable, its sine or cosine. Where no step helps as it stands, the best few are
/// polished first, and products with two such factors tried. Factors that are the same at all poses are left out: the
/// amplitude is free. The tree must be finite at all poses.
Tree rewritten(const Tree& tree, FormulaMisfit& misfit);

/// The product of three factors, each a variable, its sine or its cosine, that fits best: a beginning for rewriting
/// where selection found none, since of such a product no part shows anything alone. There is one variable at least.
Tree best_product(FormulaMisfit& misfit);

}  // namespace demecal::inline formula_search
