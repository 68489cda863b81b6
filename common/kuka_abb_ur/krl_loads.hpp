// KRL's $LOAD: what the arm carries beyond its flange.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace demecal::inline kuka_abb_ur {

/// The arguments are those of PayloadWords::kg.
/// Behind "$LOAD=": {M 5.0,CM {...}}, or the name of what the program declares so; below 0 the controller's own counts.
std::optional<double> stated_load_kg(std::string_view code, std::size_t at);
/// Behind "$LOAD.": M=6; another part says nothing of the mass.
std::optional<double> changed_load_kg(std::string_view code, std::size_t at);
/// Behind "BAS(#TOOL,": the number of a tool, with which its load is selected; no tool has the controller's own.
std::optional<double> selected_load_kg(std::string_view code, std::size_t at);
/// Behind "FDAT_ACT=": the frame data of an inline form, which name such a tool.
std::optional<double> inline_load_kg(std::string_view code, std::size_t at);
/// Behind "$LOAD" in what follows WITH: "={M 5.0}" or the name of a load, ".M=5", or "=SLOAD(3)", which is
/// LOAD_DATA[3].
std::optional<double> with_load_kg(std::string_view code, std::size_t at);

}  // namespace demecal::inline kuka_abb_ur
