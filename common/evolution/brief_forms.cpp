#include "evolution/brief_forms.hpp"

#include <cmath>

namespace demecal {

double message_nats(const Tree& tree, double square, double rows) {
  double nats = 0.5 * rows * std::log(square);
  for (const Node& node : tree) nats += node.primitive == Primitive::constant ? 1.0 + 0.5 * std::log(rows) : 1.0;
  return nats;
}

Tree BriefForms::fitted(const Tree& simple) {
  NodeStore store;
  return demecal::simplified(store.tree(fit_.by_squares(store, store.enter(simple)).root));
}

}  // namespace demecal
