#include "recordings/models/npy.hpp"

#include "core/error.hpp"
#include "tests/fuzz/entry.hpp"

namespace touchdown::fuzz {

/// A `.npy`; its array is written and read again.
TOUCHDOWN_FUZZ(npy) {
  recordings::NpyArray array;
  try {
    array = recordings::from_npy(input, "fuzz.npy");
  } catch (const Error& error) {
    expected(error, input);
    return;
  }
  const recordings::NpyArray again = recordings::from_npy(recordings::to_npy(array), "again.npy");
  if (again.shape != array.shape || again.data.size() != array.data.size()) __builtin_trap();
}

}  // namespace touchdown::fuzz
