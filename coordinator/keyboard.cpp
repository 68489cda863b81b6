#include "coordinator/keyboard.hpp"

#include <termios.h>
#include <unistd.h>
#include <array>
#include <atomic>
#include <csignal>

namespace demecal {
namespace {

constexpr std::array kEndingSignals{SIGQUIT, SIGHUP, SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL};

termios mode_before{};
std::atomic<bool> keyboard_is_taken{false};

bool is_in_front() {
  return ::tcgetpgrp(STDIN_FILENO) == ::getpgrp();
}

/// Ends the program by the same signal, whose usual action SA_RESETHAND has brought back.
void give_back_and_end(int number) {
  give_keyboard_back();
  std::raise(number);
}

void take_keyboard() {
  termios mode = mode_before;
  // Without ISIG's letters being touched: Ctrl-C and Ctrl-Z do what they always do.
  mode.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  mode.c_cc[VMIN] = 0;
  mode.c_cc[VTIME] = 0;
  ::tcsetattr(STDIN_FILENO, TCSANOW, &mode);
}

}  // namespace

void give_keyboard_back() {
  if (keyboard_is_taken.exchange(false)) ::tcsetattr(STDIN_FILENO, TCSANOW, &mode_before);
}

bool Keyboard::is_there() {
  return ::isatty(STDIN_FILENO) == 1 && is_in_front();
}

Keyboard::Keyboard() {
  if (::tcgetattr(STDIN_FILENO, &mode_before) != 0) return;
  keyboard_is_taken = true;
  for (const int number : kEndingSignals) {
    struct sigaction action {};
    action.sa_handler = give_back_and_end;
    action.sa_flags = static_cast<int>(SA_RESETHAND | SA_NODEFER);
    ::sigaction(number, &action, nullptr);
  }
  take_keyboard();
}

Keyboard::~Keyboard() {
  for (const int number : kEndingSignals) std::signal(number, SIG_DFL);
  if (is_in_front()) give_keyboard_back();
}

std::optional<char> Keyboard::key() {
  if (!keyboard_is_taken || !is_in_front()) return std::nullopt;
  termios now{};
  // Whoever was stopped and goes on finds the mode of the shell.
  if (::tcgetattr(STDIN_FILENO, &now) == 0 && (now.c_lflag & ICANON) != 0) take_keyboard();
  char letter = 0;
  return ::read(STDIN_FILENO, &letter, 1) == 1 ? std::optional(letter) : std::nullopt;
}

}  // namespace demecal
