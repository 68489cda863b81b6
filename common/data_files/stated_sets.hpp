// Whether a DATASET.yaml says itself what each pose is used for.
#pragma once

#include <filesystem>

namespace demecal::inline data_files {

/// Whether it names a column of sets or says how poses are divided; otherwise load_data_set() draws which validate.
/// Throws InputError where it is no map.
bool states_sets(const std::filesystem::path& data_set_file);

}  // namespace demecal::inline data_files
