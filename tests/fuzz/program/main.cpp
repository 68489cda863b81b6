// The fuzzer's program: scripts/fuzz says in the environment which target it tries, or has it write the seeds.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "targets.hpp"

namespace {

using demecal::fuzz::Target;

const Target* chosen = nullptr;

void write_seeds(const std::string& folder) {
  for (const Target& target : demecal::fuzz::targets()) {
    std::filesystem::create_directories(folder + "/" + target.name);
    for (std::size_t i = 0; i < target.seeds.size(); ++i)
      std::ofstream(folder + "/" + target.name + "/seed-" + std::to_string(i), std::ios::binary) << target.seeds[i];
    std::puts(target.name.c_str());
  }
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  static const std::vector<Target> all = demecal::fuzz::targets();
  if (const char* folder = std::getenv("DEMECAL_FUZZ_SEEDS")) {
    write_seeds(folder);
    std::exit(0);
  }
  const char* name = std::getenv("DEMECAL_FUZZ_TARGET");
  for (const Target& target : all)
    if (name != nullptr && target.name == name) chosen = &target;
  if (chosen == nullptr) {
    std::fprintf(stderr, "DEMECAL_FUZZ_TARGET names no target\n");
    std::exit(10);
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  chosen->read({reinterpret_cast<const char*>(bytes), size});
  return 0;
}
