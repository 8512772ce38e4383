#include "estimator/npz/npz.hpp"

#include "core/error.hpp"
#include "tests/fuzz/entry.hpp"
#include "tests/fuzz/memory_file.hpp"

namespace touchdown::fuzz {

/// A raw `.npz`.
TOUCHDOWN_FUZZ(npz) {
  const fuzz::MemoryFile file(input);
  try {
    (void)npz_names(file.path());
    (void)read_npz(file.path());
  } catch (const Error& error) {
    expected(error, input);
  }
}

}  // namespace touchdown::fuzz
