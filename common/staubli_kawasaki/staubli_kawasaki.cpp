#include "staubli_kawasaki/staubli_kawasaki.hpp"

namespace demecal::inline staubli_kawasaki {

// One row a language, defined in its own file. Programs have signs of several: those of Kawasaki's those of VAL II,
// too.
Language kawasaki_as_language();
Language val2_language();
Language val3_language();

std::vector<Language> staubli_kawasaki_languages() {
  return {kawasaki_as_language(), val2_language(), val3_language()};
}

}  // namespace demecal::inline staubli_kawasaki
