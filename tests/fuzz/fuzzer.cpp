// The replay of the corpus is compiled with all sources of this folder, a fuzzer with the name of
// its function.
#ifdef TOUCHDOWN_FUZZER

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "tests/fuzz/entry.hpp"

/// libFuzzer's entry point, for the function TOUCHDOWN_FUZZER.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  for (const touchdown::fuzz::Target& target : touchdown::fuzz::targets()) {
    if (std::string_view(target.name) != TOUCHDOWN_FUZZER) continue;
    call(target, {reinterpret_cast<const char*>(data), size});
    return 0;
  }
  std::abort();  // there is no such function
}

#endif
