// What a model declares, by the words of jobs and models.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "config/yaml_node.hpp"
#include "fitting/declared_model.hpp"

namespace demecal {

/// The model that declares what `words` say, each of them one of declared_words().
DeclaredModel declared_of(std::span<const std::string> words);
/// The same of a list in a file. Throws InputError where a word is unknown or there twice.
DeclaredModel read_declared(const YamlNode& list);

}  // namespace demecal
