#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

/// Begins the definition of a fuzzed function of `std::string_view input`. For any input, it must
/// not crash, hang, or throw anything but `touchdown::Error`. A fuzzer makes it libFuzzer's entry
/// point; the replay of the corpus links all of them together.
#ifdef TOUCHDOWN_FUZZER
#define TOUCHDOWN_FUZZ(name)                                                          \
  static void fuzz_##name(std::string_view input);                                    \
  extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) { \
    fuzz_##name({reinterpret_cast<const char*>(data), size});                         \
    return 0;                                                                         \
  }                                                                                   \
  static void fuzz_##name(std::string_view input)
#else
#define TOUCHDOWN_FUZZ(name)                \
  void fuzz_##name(std::string_view input); \
  void fuzz_##name(std::string_view input)
#endif
