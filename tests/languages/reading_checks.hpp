// What tests of readers ask: the names and numbers that were read, and where a fault is said to be.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "errors/input_error.hpp"
#include "kinematics/random_arm.hpp"
#include "languages/named_languages.hpp"

namespace demecal {

inline std::vector<std::string> names(const Program& program) {
  std::vector<std::string> found;
  for (const Target& target : program.targets) found.push_back(target.name);
  return found;
}

inline std::vector<double> values(const std::vector<Cell>& cells) {
  std::vector<double> found;
  for (const Cell& cell : cells) found.push_back(cell.value);
  return found;
}

inline void expect_fault(WrittenIn language, const std::string& text, std::size_t line, const std::string& sentence) {
  SCOPED_TRACE(text);
  try {
    read_program(language, text, "p", wrist_arm());
    ADD_FAILURE() << "no fault";
  } catch (const InputError& error) {
    EXPECT_EQ(error.where().line, line) << error.what();
    EXPECT_THAT(error.what(), ::testing::HasSubstr(sentence));
  }
}

}  // namespace demecal
