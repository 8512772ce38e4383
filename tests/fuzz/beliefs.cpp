#include "core/error.hpp"
#include "recordings/beliefs/csv.hpp"
#include "recordings/beliefs/mpack.hpp"
#include "recordings/beliefs/npz.hpp"
#include "tests/fuzz/entry.hpp"
#include "tests/fuzz/memory_file.hpp"

namespace touchdown::fuzz {

/// Beliefs in a format that the bytes need not be of.
TOUCHDOWN_FUZZ(beliefs) {
  const fuzz::MemoryFile file(input);
  for (const auto read :
       {recordings::read_belief_csv, recordings::read_belief_mpack, recordings::read_belief_npz}) {
    try {
      (void)read(file.path());
    } catch (const Error&) {  // NOLINT(bugprone-empty-catch): the answer that is expected
    }
  }
}

}  // namespace touchdown::fuzz
