#include <memory>
#include <string>

#include "cli/show_result.hpp"
#include "cli/verb.hpp"
#include "experiments/run_experiment.hpp"

namespace touchdown::cli {

namespace {

struct MergeFlags {
  std::string directory;
  ShownPictures pictures;
};

void merge(const MergeFlags& flags, const CliSession& session) {
  experiments::ExperimentResult result = experiments::merge_run(
      flags.directory, {.out = {}, .command = session.command, .stop = session.stop});
  show(result, session, flags.pictures);
}

}  // namespace

void add_merge(CLI::App& program, const CliSession& session) {
  Verb verb(program, "merge",
            "touchdown merge runs/stairs/latest\n\n"
            "Merges the results of an experiment's shards in its run directory.");
  const auto flags = std::make_shared<MergeFlags>();
  verb.option("directory", &flags->directory, "Run directory that the shards share")
      .required()
      .value_name("DIR");
  add_picture_flags(verb, &flags->pictures);
  verb.action([flags, &session] { merge(*flags, session); });
}

}  // namespace touchdown::cli
