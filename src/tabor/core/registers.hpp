#pragma once

// The vectors on which one instruction works. Where this header is included, gcc warns of vectors
// that it takes apart.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic warning "-Wvector-operation-performance"
#endif

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

/// Numbers of one register, for loops over several lists or lines side by side.
inline constexpr int kLanes = kRegisterBytes / sizeof(double);
using Lanes = double __attribute__((vector_size(kRegisterBytes)));
inline constexpr int kFloatLanes = kRegisterBytes / sizeof(float);
using FloatLanes = float __attribute__((vector_size(kRegisterBytes)));

inline Lanes in_all_lanes(double value) { return Lanes{} + value; }

}  // namespace tabor
