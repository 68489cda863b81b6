// What reads bytes that strangers write, each as a function that a fuzzer calls.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace demecal::fuzz {

/// One decoder and what is done with what it lets through. Bytes may be refused; all else that goes wrong aborts.
struct Target {
  std::string name;
  std::vector<std::string> seeds;  ///< sound bytes, from which others are made
  std::function<void(std::string_view bytes)> read;
};

/// Samples of every topic as they come over the network, encapsulation and all.
std::vector<Target> wire_targets();
/// Formulas, tables, lines of events, journals.
std::vector<Target> text_targets();
/// Robots, URDFs, jobs, data sets, scenarios, preparations, matrices, grids, models.
std::vector<Target> file_targets();
/// Robot programs of every language.
std::vector<Target> program_targets();

std::vector<Target> targets();

/// Breaks off, loudly, where a promise does not hold.
void demand(bool holds, const char* promise);

}  // namespace demecal::fuzz
