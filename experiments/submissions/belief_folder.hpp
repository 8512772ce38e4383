#pragma once

#include <filesystem>
#include <vector>

#include "experiments/submissions/exported_runs.hpp"
#include "experiments/rollouts/rollouts.hpp"

namespace touchdown::experiments {

/// A file of beliefs and the run that they are about.
struct BeliefFile {
  std::filesystem::path path;
  std::size_t heard = 0;  ///< index in the benchmark's runs
};

/// What somebody hands in.
struct Submission {
  std::vector<BeliefFile> files;  ///< about test runs, in the order of these
  std::size_t about_fitted = 0;   ///< files about fitted runs, which are not scored
};

/// The files in a folder, by the names that an export gives, or one file about the only run that is
/// called as it is. Hidden ones do not count. Errors: `InputError` for a file of another name, two
/// about one run, and none at all.
Submission handed_in(const std::filesystem::path& beliefs, const std::vector<HeardRun>& runs);

/// Reads every file once, for what is wrong with it by itself. Errors: the `InputError` of the
/// first one that is wrong; `Stopped`.
void require_sound(const std::vector<BeliefFile>& files, const ShouldContinue& should_continue);

}  // namespace touchdown::experiments
