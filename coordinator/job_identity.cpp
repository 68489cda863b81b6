#include "coordinator/job_identity.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "yaml/files.hpp"
#include "config/robot_file.hpp"

namespace demecal {

JobIdentity identity_of(const std::string& job_file, const Job& job, const DataSet& data, bool asynchronous) {
  const std::string overridden = fmt::format("\n{} {}\n", to_string(job.method), job.closed_loop.max_effects);
  return {.data_sha256 = sha256(data.sha256 + read_file(job.data_file) + robot_text(data.robot)),
          .job_sha256 = sha256(read_file(job_file) + overridden),
          .seed = job.seed,
          .version = DEMECAL_VERSION,
          .asynchronous = asynchronous};
}

bool same_folder(const std::string& a, const std::string& b) {
  std::error_code failure;
  return std::filesystem::weakly_canonical(a, failure) == std::filesystem::weakly_canonical(b, failure);
}

}  // namespace demecal
