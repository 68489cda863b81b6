// Functions compiled for several vector units, of which the widest present is taken at run time, and their loops.
#pragma once

/// Stands before a definition. All versions give the same bits, since no operation is contracted or reordered and fused
/// multiply-adds are written out. Sanitizers are not ready yet when the program's loader makes the choice.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(DEMECAL_SANITIZED)
#define DEMECAL_FOR_EACH_VECTOR_UNIT __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define DEMECAL_FOR_EACH_VECTOR_UNIT
#endif

/// Stands before a loop whose steps depend on no other step, though the compiler cannot know that the columns are
/// apart. The sanitizers' checks stand within such loops, where g++ would warn that it ignores what it was told.
#if defined(__GNUC__) && !defined(__clang__) && !defined(DEMECAL_SANITIZED)
#define DEMECAL_ROWS_APART _Pragma("GCC ivdep")
#else
#define DEMECAL_ROWS_APART
#endif
