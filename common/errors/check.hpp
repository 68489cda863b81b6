// A programmer's error: stops the program and shows the values of the broken condition.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <sstream>

/// Aborts with file, line, the broken condition and the streamed values: DEMECAL_CHECK(i < n, "i=" << i).
#define DEMECAL_CHECK(condition, values)                                                     \
  do {                                                                                       \
    if (!(condition)) {                                                                      \
      std::ostringstream demecal_check_stream;                                               \
      demecal_check_stream << values;                                                        \
      std::fprintf(stderr, "%s:%d: check failed: %s (%s)\n", __FILE__, __LINE__, #condition, \
                   demecal_check_stream.str().c_str());                                      \
      std::abort();                                                                          \
    }                                                                                        \
  } while (false)
