#pragma once

/// Marks a function that is compiled for several instruction sets and picked when the program
/// starts. With -ffp-contract=off, and no reordering of sums, all of them give the same bits.
/// tests/e2e/dispatch_test.sh compares them; for that KAGEFUDE_ONE_LEVEL names the only one to
/// compile, and KAGEFUDE_PLAIN leaves them all out. Left out under sanitizers, which instrument the
/// resolver before they are ready.
#if defined(KAGEFUDE_PLAIN)
#define KAGEFUDE_CLONES
#elif defined(KAGEFUDE_ONE_LEVEL)
#define KAGEFUDE_CLONES __attribute__((target(KAGEFUDE_ONE_LEVEL)))
#elif defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define KAGEFUDE_CLONES __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#else
#define KAGEFUDE_CLONES
#endif
