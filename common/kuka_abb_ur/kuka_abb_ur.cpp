#include "kuka_abb_ur/kuka_abb_ur.hpp"

namespace demecal::inline kuka_abb_ur {

// One row a language, defined in its own file.
Language rapid_language();
Language krl_language();
Language urscript_language();

std::vector<Language> kuka_abb_ur_languages() {
  return {rapid_language(), krl_language(), urscript_language()};
}

}  // namespace demecal::inline kuka_abb_ur
