#include "logs/log/beliefs.hpp"

#include <functional>

#include "core/error.hpp"
#include "logs/log/contact_intervals.hpp"
#include "tests/fuzz/entry.hpp"
#include "tests/fuzz/memory_file.hpp"

namespace touchdown::fuzz {

/// Bytes read as every format of beliefs, and as a person's contact labels.
TOUCHDOWN_FUZZ(beliefs) {
  const fuzz::MemoryFile file(input);
  const std::filesystem::path path = file.path();
  for (const std::function<void()>& read : std::initializer_list<std::function<void()>>{
           [&] { (void)logs::read_belief_csv(path); }, [&] { (void)logs::read_belief_mpack(path); },
           [&] { (void)logs::read_belief_npz(path); },
           [&] { (void)logs::read_contact_intervals(path); }}) {
    try {
      read();
    } catch (const Error& error) {
      expected(error, input);
    }
  }
}

}  // namespace touchdown::fuzz
