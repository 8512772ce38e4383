#include "core/error.hpp"
#include "estimator/npz/npz.hpp"
#include "tests/fuzz/entry.hpp"

namespace touchdown::fuzz {

/// A `.npy`; its array is written and read again.
TOUCHDOWN_FUZZ(npy) {
  ModelArray array;
  try {
    array = from_npy(input, "fuzz.npy");
  } catch (const Error& error) {
    expected(error, input);
    return;
  }
  const ModelArray again = from_npy(to_npy(array), "again.npy");
  if (again.shape != array.shape || again.data.size() != array.data.size()) __builtin_trap();
}

}  // namespace touchdown::fuzz
