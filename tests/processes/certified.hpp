// A calibrated arm of simulated data that certificates are made of, and what a certificate says.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "program.hpp"
#include "small_job.hpp"

namespace demecal {

/// A model found on simulated data, and certificates of it.
class Certified {
 public:
  explicit Certified(const std::string& stated = "") {
    std::ofstream(job_.data(), std::ios::app) << stated;
    const Ended ended = run("demecal", {"diagnose", job_.data(), "--declare", "registration,joint_corrections",
                                        "--candidates", "joint_offset,gear_harmonic", "--out", job_.path("out")});
    EXPECT_EQ(ended.code, 0) << ended.err;
  }

  Ended certify(const std::string& tolerance, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{"certify", job_.path("out/model.yaml"), job_.data(), "--tolerance", tolerance,
                                       "--out",   job_.path("signed")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run("demecal", arguments);
  }
  std::string text(const std::string& name) const { return job_.text(name); }
  std::string path(const std::string& name) const { return job_.path(name); }

 private:
  SmallJob job_;
};

inline bool has(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

/// The words of a PDF; empty where nothing reads it.
inline std::string words_of_pdf(const std::string& path) {
  const std::string text = path + ".txt";
  if (std::system(("pdftotext -layout '" + path + "' '" + text + "' 2>/dev/null").c_str()) != 0) return {};
  std::ifstream file(text);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace demecal
