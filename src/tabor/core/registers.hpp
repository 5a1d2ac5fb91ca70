#pragma once

// Says how long the vectors are on which one instruction works.
namespace tabor {

/// Bytes of a vector register of the processor that this is compiled for. Compilers take longer
/// vectors apart, comparisons even value by value.
#if defined(__AVX512F__)
inline constexpr int kRegisterBytes = 64;
#elif defined(__AVX__)
inline constexpr int kRegisterBytes = 32;
#else
inline constexpr int kRegisterBytes = 16;
#endif

}  // namespace tabor
