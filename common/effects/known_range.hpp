// How effects end where what was measured ends.
#pragma once

namespace demecal {

/// Over which a ripple fades out beyond the joints it was measured at, rad or m.
inline constexpr double kFade = 0.1;

}  // namespace demecal
