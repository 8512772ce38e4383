#include <memory>

#include <fmt/format.h>

#include "cli/verbs.hpp"
#include "core/progress.hpp"
#include "experiments/export_benchmark.hpp"

namespace touchdown::cli {

namespace {

struct ExportFlags {
  std::string source;
  std::string folder;
  experiments::BenchmarkPart part;
  bool dry_run = false;
};

void export_benchmark(const ExportFlags& flags, const CliSession& session) {
  const experiments::ExportRequest request{flags.source, flags.folder, flags.part};
  if (flags.dry_run) {
    fmt::print("{}", experiments::export_outline(request));
    return;
  }
  const experiments::ExportReport report = experiments::export_benchmark(
      request, {.out = {}, .command = session.command, .stop = session.stop});
  if (!report.failed.empty()) {
    tell(fmt::format("touchdown: {} runs fell and are not scored, so they are left out: {}\n",
                     report.failed.size(), fmt::join(report.failed, ", ")));
  }
  fmt::print("signals   {} files, {:.1f} MB, in {}\n", report.files,
             1e-6 * static_cast<double>(report.bytes), flags.folder);
  fmt::print("read      {0}/README.md, {0}/index.csv\n", flags.folder);
  fmt::print("next      touchdown score RUN --beliefs FOLDER --name NAME\n");
}

}  // namespace

void add_export(CLI::App& program, const CliSession& session) {
  Verb verb(program, "export",
            "touchdown export --benchmark signals experiments/benchmark.yaml\n"
            "touchdown export --benchmark signals runs/benchmark/latest --robot upkie\n\n"
            "Writes what estimators of a benchmark hear, for an estimator in any language. What\n"
            "it believes is then scored by `touchdown score`.");
  const auto flags = std::make_shared<ExportFlags>();
  verb.option("source", &flags->source,
              "Experiment file with a section `benchmark`, or the run "
              "directory of one")
      .value_name("RUN_OR_EXPERIMENT")
      .required();
  verb.option("--benchmark", &flags->folder, "New or empty folder for the files")
      .value_name("DIR")
      .required();
  verb.option("--robot", &flags->part.robots, "Only this robot, as the benchmark's table names it")
      .value_name("NAME")
      .one_at_a_time();
  verb.option("--sensors", &flags->part.sensors, "Only these sensors, likewise")
      .value_name("NAME")
      .one_at_a_time();
  verb.option("--simulator", &flags->part.simulators, "Only this engine")
      .value_name("NAME")
      .one_at_a_time();
  verb.flag("--dry-run", &flags->dry_run, "Only show how many files it would be, and how large");
  verb.action([flags, &session] { export_benchmark(*flags, session); });
}

}  // namespace touchdown::cli
