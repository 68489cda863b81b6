// The keys of whoever sits at the terminal, one by one, for programs that show a page there.
#pragma once

#include <optional>

namespace demecal {

/// Reads standard input key by key, unseen, while it lives. The terminal is given back as it was when this goes, and by
/// every signal that ends the program but SIGKILL. One at a time.
class Keyboard {
 public:
  /// Whether standard input is a terminal, and this program the one in front of it: any other is stopped if it reads.
  static bool is_there();

  /// Needs is_there().
  Keyboard();
  ~Keyboard();
  Keyboard(const Keyboard&) = delete;
  Keyboard& operator=(const Keyboard&) = delete;

  /// What was pressed and not taken yet, if anything; never waits.
  std::optional<char> key();
};

/// Gives the terminal back as it was before a Keyboard took it, if one did; for handlers of signals, too.
void give_keyboard_back();

}  // namespace demecal
