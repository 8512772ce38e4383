#pragma once

#include <filesystem>
#include <vector>

#include "experiments/plan/rollouts.hpp"
#include "experiments/submissions/exported_runs.hpp"

namespace touchdown::experiments {

/// A file of beliefs about one run.
struct BeliefFile {
  std::filesystem::path path;
  std::size_t run = 0;  ///< index in the exported runs
};

/// The files of a submission.
struct Submission {
  std::vector<BeliefFile> files;  ///< about test runs, in the order of the runs
  std::size_t about_fitted = 0;   ///< files about fitted runs, which are not scored
};

/// Finds the files of a submission: those in a folder, named as in the export, or one file with the
/// name of exactly one run. Hidden files are ignored. Errors: `InputError` for a file with another
/// name, two files about one run, and no file at all.
Submission submission_in(const std::filesystem::path& beliefs,
                         const std::vector<ExportedRun>& runs);

/// Reads every file once to check its content. Errors: the `InputError` of the first invalid file;
/// `Stopped`.
void require_sound(const std::vector<BeliefFile>& files, const ShouldContinue& should_continue);

}  // namespace touchdown::experiments
