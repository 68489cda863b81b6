#include "coordinator/monitor_screen.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>
#include <utility>

#include "terminal/monitor_page.hpp"

namespace demecal {
namespace {

constexpr std::chrono::milliseconds kSoonest{150};
constexpr std::chrono::milliseconds kLatest{1000};
constexpr const char* kOtherScreen = "\033[?1049h\033[?25l";
constexpr const char* kBack = "\033[?1049l\033[?25h";

struct Size {
  std::size_t columns = 100, lines = 0;
};

Size size_of(std::FILE* out) {
  winsize size{};
  if (::ioctl(::fileno(out), TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return {size.ws_col, size.ws_row};
  const char* const columns = std::getenv("COLUMNS");
  const long width = columns == nullptr ? 0 : std::strtol(columns, nullptr, 10);
  return width > 0 && width < 1000 ? Size{static_cast<std::size_t>(width), 0} : Size{};
}

std::string joined(const std::vector<std::string>& lines, const char* end) {
  std::string text;
  for (const std::string& line : lines) text += line + end;
  return text;
}

}  // namespace

MonitorScreen::MonitorScreen(std::FILE* out, std::string place)
    : out_(out),
      place_(std::move(place)),
      terminal_(::isatty(::fileno(out)) == 1),
      colours_(terminal_ && std::getenv("NO_COLOR") == nullptr) {}

MonitorScreen::~MonitorScreen() {
  if (!in_place_) return;
  std::fputs(kBack, out_);
  std::fputs(last_.c_str(), out_);
  std::fflush(out_);
}

void MonitorScreen::offer(const Watched& watched, double now_s, bool changed) {
  changed_ = changed_ || changed;
  const auto since = Clock::now() - drawn_;
  const bool is_due = terminal_ ? since >= kLatest || (changed_ && since >= kSoonest) : changed_ && since >= kLatest;
  if (is_due) draw(watched, now_s);
}

void MonitorScreen::settle(const Watched& watched, double now_s) {
  if (changed_) draw(watched, now_s);
}

void MonitorScreen::draw(const Watched& watched, double now_s) {
  changed_ = false;
  drawn_ = Clock::now();
  if (terminal_) {
    redraw(watched, now_s);
  } else {
    print(watched, now_s);
    std::fputs("\n", out_);
    std::fflush(out_);
  }
}

void MonitorScreen::redraw(const Watched& watched, double now_s) {
  const Size size = size_of(out_);
  const auto page = [&](std::size_t lines) {
    return monitor_page(watched, {size.columns, lines, colours_, now_s, place_});
  };
  if (!std::exchange(in_place_, true)) std::fputs(kOtherScreen, out_);
  // The last line ends without a line break: it would move the page up.
  std::string text = joined(page(size.lines), "\033[K\r\n");
  text.resize(text.size() - 2);
  std::fputs(("\033[H" + text + "\033[J").c_str(), out_);
  std::fflush(out_);
  last_ = joined(page(0), "\n");
}

void MonitorScreen::print(const Watched& watched, double now_s) {
  const Size size = size_of(out_);
  std::fputs(joined(monitor_page(watched, {size.columns, 0, colours_, now_s, place_}), "\n").c_str(), out_);
  std::fflush(out_);
}

}  // namespace demecal
