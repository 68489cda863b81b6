// The scripts of the page's part on single poses, in the order in which they stand in it, as one function.
#pragma once

#include <string_view>

namespace demecal::inline html {

/// What all parts share: the data, the choice of poses, colours; see pose_data().
std::string_view pose_core_script();
/// The table that sorts, filters and turns pages.
std::string_view pose_table_script();
/// The arm with its error vectors, turned by pointer, keys or buttons.
std::string_view pose_view_script();
/// Histogram, cumulative curve, and errors against what was measured.
std::string_view pose_plots_script();

}  // namespace demecal::inline html
