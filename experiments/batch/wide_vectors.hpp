#pragma once

#include <cstddef>

/// Where a function is compiled twice, for the build's processor and for vectors of 512 bits, the
/// program picks one at run time. Both give the same bits: each operation stays the same, and no
/// sum changes its order. That needs a build with fused multiplications (x86-64-v3). Sanitizers
/// start too late for the choice.
#if defined(__GNUC__) && !defined(__clang__) && defined(__FMA__) && defined(__linux__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define TOUCHDOWN_HAS_WIDE_VECTORS
/// Marks a function with loops that fill such vectors with elements of a batch.
#define TOUCHDOWN_WIDE_VECTORS [[gnu::target_clones("arch=x86-64-v4", "default")]]
#else
#define TOUCHDOWN_WIDE_VECTORS
#endif

namespace touchdown::experiments {

/// The number of doubles in such a vector. Arrays of batch elements are padded to it.
inline constexpr std::size_t batch_width = 8;

/// The next multiple of that number.
constexpr std::size_t padded_to_batch_width(std::size_t count) noexcept {
  return (count + batch_width - 1) / batch_width * batch_width;
}

}  // namespace touchdown::experiments
