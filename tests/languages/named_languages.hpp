// The languages that tests write programs in, by name.
#pragma once

#include "languages/languages.hpp"

namespace demecal {

enum class WrittenIn { val2, csv, krl, rapid, urscript, fanuc_ls, yaskawa_jbi, kawasaki_as, val3 };

inline constexpr WrittenIn kLanguages[] = {WrittenIn::val2,        WrittenIn::csv,         WrittenIn::krl,
                                           WrittenIn::rapid,       WrittenIn::urscript,    WrittenIn::fanuc_ls,
                                           WrittenIn::yaskawa_jbi, WrittenIn::kawasaki_as, WrittenIn::val3};

inline std::string to_string(WrittenIn language) {
  constexpr const char* kNames[] = {"val2",     "csv",         "krl",         "rapid", "urscript",
                                    "fanuc_ls", "yaskawa_jbi", "kawasaki_as", "val3"};
  return kNames[static_cast<std::size_t>(language)];
}

/// Whether its targets may be joints; a Yaskawa job has them in pulses only.
inline bool has_joint_targets(WrittenIn language) {
  return language != WrittenIn::yaskawa_jbi;
}

inline const Language& row_of(WrittenIn language) {
  return *find_language(to_string(language));
}

inline Program read_program(WrittenIn language, std::string_view text, const std::string& file, const Chain& arm) {
  return read_program(row_of(language), text, file, arm);
}

}  // namespace demecal
