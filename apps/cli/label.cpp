#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/cli/log_options.hpp"
#include "apps/cli/verb.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/program.hpp"
#include "core/progress.hpp"
#include "core/stop.hpp"
#include "core/table.hpp"
#include "experiments/logs/estimator.hpp"
#include "experiments/logs/log_steps.hpp"
#include "experiments/results/captions.hpp"
#include "logs/log/contact_intervals.hpp"

namespace touchdown::cli {

namespace {

struct LabelFlags {
  std::string log;
  LogOptions options;
  std::string output;
};

/// The intervals to look at first.
std::string least_sure(std::vector<logs::ContactInterval> intervals) {
  constexpr std::size_t most = 12;
  std::stable_sort(intervals.begin(), intervals.end(),
                   [](const auto& one, const auto& other) { return one.sure < other.sure; });
  const std::size_t shown = std::min(intervals.size(), most);
  TextTable table{{"sure", "from (s)", "to (s)", "left", "right"}, {}};
  for (const logs::ContactInterval& one : std::span(intervals).first(shown)) {
    const auto word = [](bool contact) { return contact ? "contact" : "air"; };
    table.rows.push_back({fmt::format("{:.3f}", one.sure.value_or(1.0)),
                          fmt::format("{:.3f}", one.start), fmt::format("{:.3f}", one.end),
                          word(one.contact[0]), word(one.contact[1])});
  }
  return fmt::format(
      "least sure first{}:\n{}",
      shown < intervals.size() ? fmt::format(", {} of {}", shown, intervals.size()) : "",
      to_text(table));
}

void label(const LabelFlags& flags, const CliSession& session) {
  const experiments::LogEstimator estimator = estimator_for(flags.options);
  std::vector<InputFile> inputs = {{flags.log, "log"}};
  if (!flags.options.model.empty()) inputs.push_back({flags.options.model, "model"});
  check_outputs(inputs, {flags.output});
  require_extension(flags.output, {".csv"}, "a file of labels");
  logs::LogReader reader = open_log(flags.log, flags.options, session);
  experiments::LogSteps log(reader, nullptr, estimator.request.robot);
  const logs::ContactIntervals labels = experiments::proposed_labels(log, estimator);
  end_if(session.stop);
  print_warnings(reader.warnings());
  print_findings(reader.name(), log.findings());
  if (labels.intervals.empty()) {
    throw Error(fmt::format("{}: none of its steps has usable signals", reader.name()));
  }
  double seconds = 0.0;
  for (const logs::ContactInterval& one : labels.intervals) seconds += one.end - one.start;
  const std::string proposal = logs::to_csv(labels);
  if (is_there(flags.output) && read_file(flags.output) != proposal) {
    throw InputError(fmt::format(
        "{}: is there already, and differs from this proposal: expected a new file, because a "
        "person may have corrected that one",
        flags.output));
  }
  write_atomically(flags.output, proposal);
  print("{}: {}, {:.3f} s\n{}", flags.output,
        experiments::plural(labels.intervals.size(), "interval"), seconds,
        least_sure(labels.intervals));
  const std::string robot = flags.options.robot.empty() ? "" : " --robot " + flags.options.robot;
  const bool is_mapped = !flags.options.mapping.empty();
  const std::string mapping = is_mapped ? " --mapping " + flags.options.mapping : "";
  print("{:<12} touchdown watch {} --labels {}{}{}\n", "next", flags.log, flags.output, robot,
        mapping);
  print("{:<12} touchdown estimate {} --labels {}{}{}\n", "then", flags.log, flags.output, robot,
        mapping);
}

}  // namespace

void add_label(CLI::App& program, const CliSession& session) {
  Verb verb(program, "label",
            "touchdown label robot.mpack -o labels.csv\n\n"
            "Proposes contact labels of a log, for a person to correct: the estimator's decisions, "
            "the\nleast sure first. `touchdown estimate --labels` scores estimators by the file.");
  const auto flags = std::make_shared<LabelFlags>();
  verb.option("log", &flags->log, "Log in Upkie's layout, or in another one with --mapping")
      .value_name("LOG")
      .required();
  add_log_options(verb, flags->options);
  verb.option("-o,--output", &flags->output, "Labels to write: rows start,end,left,right,sure")
      .value_name("FILE.csv")
      .required();
  verb.action([flags, &session] { label(*flags, session); });
}

}  // namespace touchdown::cli
