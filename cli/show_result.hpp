#pragma once

#include "cli/verb.hpp"
#include "experiments/run_experiment.hpp"

namespace touchdown::cli {

/// Which pictures are drawn of a result.
struct ShownPictures {
  bool none = false;      ///< tables only
  bool no_video = false;  ///< figures and the report, without films
};

/// Adds the flags `--no-pictures` and `--no-video`.
void add_picture_flags(Verb& verb, ShownPictures* pictures);

/// Prints an experiment's result and its paths, and draws its figures and videos. Errors: `Error`
/// if a demanded verdict fails.
void show(experiments::ExperimentResult& result, const CliSession& session,
          const ShownPictures& pictures);

}  // namespace touchdown::cli
