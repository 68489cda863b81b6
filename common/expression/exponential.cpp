#include "expression/exponential.hpp"

#include "expression/vector_units.hpp"

namespace demecal {

DEMECAL_FOR_EACH_VECTOR_UNIT
double bounded_exponential(double x) {
  return inline_bounded_exponential(x);
}

DEMECAL_FOR_EACH_VECTOR_UNIT
double protected_logarithm(double x) {
  return inline_protected_logarithm(x);
}

DEMECAL_FOR_EACH_VECTOR_UNIT
double hyperbolic_tangent(double x) {
  return inline_hyperbolic_tangent(x);
}

DEMECAL_FOR_EACH_VECTOR_UNIT
double arc_tangent(double x) {
  return inline_arc_tangent(x);
}

}  // namespace demecal
