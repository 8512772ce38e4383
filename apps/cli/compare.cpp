#include "experiments/results/compare.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "apps/cli/estimate_outputs.hpp"
#include "apps/cli/verb.hpp"
#include "core/files.hpp"
#include "core/program.hpp"
#include "experiments/results/result_files.hpp"
#include "render/gnuplot/facets.hpp"

namespace touchdown::cli {

namespace {

namespace fs = std::filesystem;

struct CompareFlags {
  std::string before;
  std::string after;
  std::string output;
  std::string figure;
  std::string metric = experiments::compared_metrics.front().name;
};

std::vector<std::string> metric_names() {
  std::vector<std::string> names;
  for (const auto& metric : experiments::compared_metrics) names.emplace_back(metric.name);
  return names;
}

/// Checks the outputs before anything is read.
void check_outputs_of(const CompareFlags& flags, const fs::path& stem) {
  std::vector<InputFile> inputs;
  for (const fs::path run : {flags.before, flags.after}) {
    inputs.push_back({run / "config.yaml", "run's config.yaml"});
    for (const fs::path& table : entries_in(run / "tables"))
      inputs.push_back({table, "run's table"});
  }
  std::vector<fs::path> outputs = figure_files(stem);
  if (!flags.output.empty()) {
    require_extension(flags.output, {".csv"}, "a table");
    outputs.emplace_back(flags.output);
  }
  check_outputs(inputs, outputs);
}

void compare(const CompareFlags& flags) {
  const fs::path stem = figure_stem(flags.figure);
  check_outputs_of(flags, stem);
  for (const std::string& run : {flags.before, flags.after}) {
    print_warnings(experiments::config_warnings(run));
    const std::vector<std::string> edited = experiments::edited_tables(run);
    if (std::ranges::find(edited, "samples.csv") == edited.end()) continue;
    print_warnings({fmt::format(
        "{}/tables/samples.csv: was edited since the run wrote it: it is compared as it is now",
        run)});
  }
  const experiments::Comparison comparison = experiments::compare(
      experiments::read_samples(flags.before), experiments::read_samples(flags.after));
  const std::vector<std::string> names = metric_names();
  const auto metric =
      static_cast<std::size_t>(std::find(names.begin(), names.end(), flags.metric) - names.begin());
  print(experiments::comparison_text(comparison, metric));
  const Table table = experiments::comparison_table(comparison);
  if (!flags.output.empty()) {
    write_atomically(flags.output, to_csv(table));
    print("table     {}\n", flags.output);
  }
  if (flags.figure.empty()) return;
  const auto figure =
      render::draw_facets(experiments::comparison_figure(comparison, metric), table, stem);
  print("figure    {}\n", figure ? figure->png.string() : "none: nothing changed");
}

}  // namespace

void add_compare(CLI::App& program, const CliSession& /*session*/) {
  Verb verb(
      program, "compare",
      "touchdown compare runs/stairs/1f3a runs/stairs/latest\n"
      "touchdown compare before after -o compare.csv --figure compare.png\n\n"
      "Compares two runs of an experiment, before and after a change of settings or build: the\n"
      "cells of engine, estimator and noise that moved by more than chance. The same test runs\n"
      "are compared in pairs.");
  const auto flags = std::make_shared<CompareFlags>();
  verb.option("before", &flags->before, "Run directory").required();
  verb.option("after", &flags->after, "Run directory after the change").required();
  verb.option("-o,--output", &flags->output, "Table of all cells").value_name("FILE.csv");
  verb.option("--figure", &flags->figure,
              "Figure of the differences, in the noise settings with the largest ones")
      .value_name("FILE.png");
  verb.option("--metric", &flags->metric,
              "accuracy or balanced_accuracy, in text and figure; the table has both")
      .one_of(metric_names())
      .shows_default();
  verb.action([flags] { compare(*flags); });
}

}  // namespace touchdown::cli
