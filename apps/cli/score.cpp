#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "apps/cli/verb.hpp"
#include "core/files.hpp"
#include "core/program.hpp"
#include "experiments/studies/benchmark.hpp"
#include "experiments/submissions/score_beliefs.hpp"
#include "render/figures/chosen_run.hpp"
#include "render/gnuplot/facets.hpp"
#include "render/report/report.hpp"
#include "render/studies/benchmark.hpp"
#include "render/studies/registry.hpp"

namespace touchdown::cli {

namespace {

/// One line for each kind of file that was not scored, with the reason.
std::string left_out(const experiments::BeliefReport& report) {
  std::string text;
  if (!report.without.empty()) {
    constexpr std::size_t most = 5;
    std::vector<std::string> some = report.without;
    if (some.size() > most) {
      some.resize(most);
      some.push_back(fmt::format("{} more", report.without.size() - most));
    }
    text += fmt::format("No beliefs about {} files, which are not scored: {}\n",
                        report.without.size(), fmt::join(some, ", "));
  }
  if (report.about_fitted > 0) {
    text +=
        fmt::format("{} files are about fitted runs, which are not scored\n", report.about_fitted);
  }
  if (report.about_failed > 0) {
    text += fmt::format("{} files are about runs that fell, which are not scored\n",
                        report.about_failed);
  }
  if (report.missing_steps > 0) {
    text += fmt::format("{} steps in {} files have no belief: the previous belief is used\n",
                        report.missing_steps, report.files_with_missing);
  }
  return text;
}

void write_report_again(const std::filesystem::path& run, const CliSession& session) {
  const render::ReportSubject subject = render::read_subject(run);
  const Table standings = render::benchmark_tables(run).standings;
  for (const auto& figure : experiments::standings_figures(standings, subject.experiment)) {
    render::draw_facets(figure, standings,
                        render::figure_file(run, figure.name, subject.experiment.figures));
  }
  std::vector<render::FilmedRun> filmed;
  if (subject.experiment.video.enabled) filmed = render::filmed_runs(subject);
  render::film_for_report(filmed, subject.experiment, run, session.stop);
  const std::filesystem::path report =
      render::make_report(subject, filmed, render::study_pictures(), {});
  print(fmt::format("report    {}\n", report.string()));
}

void score(const experiments::BeliefRequest& request, const CliSession& session) {
  const experiments::BeliefReport report = experiments::score_beliefs(
      request, {.out = {}, .command = session.command, .stop = session.stop});
  print(fmt::format("{}\n{}: {} runs scored, each through one noise setting\n{}", report.table,
                    report.name, report.scored, left_out(report)));
  print(fmt::format("table     {}\n", (request.run / "tables" / "benchmark.csv").string()));
  if (is_there(request.run / "report.html")) write_report_again(request.run, session);
}

}  // namespace

void add_score(CLI::App& program, const CliSession& session) {
  struct ScoreFlags {
    std::string run;
    std::string beliefs;
    std::string name;
  };
  Verb verb(
      program, "score",
      "touchdown score runs/benchmark/latest --beliefs mine\n\n"
      "Scores the beliefs of an external estimator about the signals of `touchdown convert`. The\n"
      "scores are listed beside those of the benchmark's own estimators.");
  const auto flags = std::make_shared<ScoreFlags>();
  verb.option("directory", &flags->run, "Run directory of a finished benchmark")
      .value_name("RUN")
      .required();
  verb.option("--beliefs", &flags->beliefs,
              "Folder of belief files with the names of the exported files (.csv, .npz or .mpack), "
              "or one file")
      .value_name("FOLDER_OR_FILE")
      .required();
  verb.option("--name", &flags->name, "Name of the estimator (default: the folder's name)")
      .value_name("NAME");
  verb.action([flags, &session] { score({flags->run, flags->beliefs, flags->name}, session); });
}

}  // namespace touchdown::cli
