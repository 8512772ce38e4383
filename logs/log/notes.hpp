#pragma once

#include <atomic>
#include <string>
#include <vector>

namespace touchdown::logs {

/// What passes between the caller and the sources of a log beside its rows. Sources add lines where
/// they know a fact; those that count are complete at the end of the log.
struct LogNotes {
  const std::atomic<bool>* stop = nullptr;  ///< reading ends once it is true; null: never
  std::vector<std::string> warnings = {};   ///< what is left out, held or not used
  std::vector<std::string> findings = {};   ///< what makes the rows wrong
};

}  // namespace touchdown::logs
