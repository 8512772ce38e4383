#include "experiments/results/text_tables.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <string_view>

#include <fmt/format.h>

#include "core/rows.hpp"
#include "experiments/estimators/baselines.hpp"
#include "experiments/plan/rollouts.hpp"
#include "experiments/results/captions.hpp"
#include "experiments/results/scores.hpp"

namespace touchdown::experiments {

namespace {

using Rows = std::vector<TableRow>;

/// The scores of both wheels in one noise setting.
Rows wheels_at(const Table& scores, const noise::NoiseCell& cell) {
  return where(scores.all(), [&](const TableRow& row) {
    return row.text("view") == scoring::scored_views().front() && is_at(row, cell);
  });
}

Rows of_engine(const Rows& rows, const std::string& simulator) {
  return where(rows, [&](const TableRow& row) { return row.text("simulator") == simulator; });
}

/// A metric without its interval; a dash where it is not defined.
std::string plain(const TableRow& score, const char* metric, const char* format) {
  const double value = score.number(metric);
  return std::isnan(value) ? "–" : fmt::format(fmt::runtime(format), value);
}

/// Every estimator of one engine in one cell.
TextTable cell_table(const ExperimentResult& result, const std::string& simulator,
                     const noise::NoiseCell& cell) {
  TextTable table{
      {"estimator", "F1 of takeoffs and landings", "extra switches/min", "long errors (s/min)",
       "takeoff (ms)", "landing (ms)", "precision of air", "balanced accuracy"},
      {}};
  for (const TableRow& score : of_engine(wheels_at(result.tables.scores, cell), simulator)) {
    table.rows.push_back({estimator_title_in(result.experiment, score.text("estimator")),
                          with_interval(score.interval("event_f1")),
                          plain(score, "extra_switches_per_minute", "{:.1f}"),
                          plain(score, "long_errors_s_per_minute", "{:.2f}"),
                          plain(score, "takeoff_latency_median_ms", "{:+.1f}"),
                          plain(score, "landing_latency_median_ms", "{:+.1f}"),
                          plain(score, "no_contact_precision", "{:.3f}"),
                          with_interval(score.interval("balanced_accuracy"))});
  }
  return table;
}

/// One estimator's success rate over the noise grid.
TextTable grid_table(const Table& cells, const std::string& simulator, const std::string& estimator,
                     const noise::NoiseGridConfig& noise) {
  TextTable table{{"torque noise"}, {}};
  for (const double level : noise.accelerometer) {
    table.header.push_back(fmt::format("{} m/s²", level));
  }
  for (const double torque : noise.torque) table.rows.push_back({fmt::format("{} N·m", torque)});
  for (const TableRow& cell : of_engine(cells.all(), simulator)) {
    if (cell.text("estimator") != estimator) continue;
    const auto row = std::ranges::find(noise.torque, cell.number("torque_noise_nm"));
    const bool on_grid =
        row != noise.torque.end() &&
        std::ranges::find(noise.accelerometer, cell.number("accelerometer_noise_mps2")) !=
            noise.accelerometer.end();
    if (!on_grid) continue;
    table.rows[static_cast<std::size_t>(row - noise.torque.begin())].push_back(
        fmt::format("{:.3f}{}", cell.number("success"), loses(cell) ? "*" : ""));
  }
  return table;
}

/// The paper's Tables I to III: real robot, 10 drops, no intervals.
struct PaperRow {
  std::string classification;
  std::string transitions;
  std::string latency;
};

const PaperRow* paper_row(const std::string& estimator) {
  static const PaperRow bayes = {"1.0 / 1.0 / 0.55 / 0.37", "0.91 / 1.0 / 0.71 / 1.0",
                                 "77.1 ± 31.8 / 17.9 ± 9.1"};
  static const PaperRow measurement = {"1.0 / 1.0 / 0.53 / 0.40", "0.59 / 1.0 / 0.55 / 1.0",
                                       "83.1 ± 31.9 / 10.1 ± 7.4"};
  static const PaperRow neural = {"0.99 / 1.0 / 0.28 / 0.15", "0.53 / 0.90 / 0.56 / 0.90",
                                  "125.0 ± 59.6 / 22.4 ± 7.4"};
  // `robust` is no estimator of the paper.
  static const std::map<std::string, const PaperRow*> rows = {{"reference", &bayes},
                                                              {"paper", &bayes},
                                                              {"measurement_only", &measurement},
                                                              {"nmn", &neural}};
  const auto found = rows.find(estimator);
  return found == rows.end() ? nullptr : found->second;
}

std::string latency_cell(const TableRow& score, const std::string& event) {
  const Interval mean = score.interval(event + "_latency_ms");
  const Interval deviation = score.interval(event + "_latency_deviation_ms");
  if (std::isnan(mean.estimate)) return "–";
  std::string text = fmt::format("{} ± {}", fixed(mean.estimate, 1), fixed(deviation.estimate, 1));
  if (std::isnan(mean.low)) return text;
  return fmt::format("{} [{}, {}]", text, fixed(mean.low, 1), fixed(mean.high, 1));
}

std::string metric_cell(const TableRow& score, const std::string& metric) {
  return with_interval(score.interval(metric));
}

/// One column per name, filled by `cell`; the last column has the paper's numbers, if one of the
/// estimators is among its own.
TextTable table_of(const Experiment& experiment, const Rows& scores,
                   const std::vector<std::string>& names,
                   std::string (*cell)(const TableRow&, const std::string&),
                   std::string PaperRow::*reference) {
  TextTable table{{"simulator", "estimator"}, {}};
  for (std::string name : names) {
    std::replace(name.begin(), name.end(), '_', ' ');
    table.header.push_back(name);
  }
  const bool has_paper = std::ranges::any_of(
      scores, [](const TableRow& score) { return paper_row(score.text("estimator")) != nullptr; });
  if (has_paper) table.header.emplace_back(paper_column);
  for (const TableRow& score : scores) {
    const std::string estimator = score.text("estimator");
    std::vector<std::string> row = {score.text("simulator"),
                                    estimator_title_in(experiment, estimator)};
    for (const std::string& name : names) row.push_back(cell(score, name));
    const PaperRow* paper = paper_row(estimator);
    if (has_paper) row.push_back(paper == nullptr ? "–" : paper->*reference);
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string joined(const std::vector<std::string>& cells, const std::string& between,
                   std::string (*text_of)(const std::string&)) {
  std::vector<std::string> texts;
  for (const std::string& cell : cells) texts.push_back(text_of(cell));
  return fmt::format("{}", fmt::join(texts, between));
}

/// Escapes characters that are markup in LaTeX.
std::string latex_text(const std::string& text) {
  static const std::vector<std::pair<std::string, std::string>> replacements = {
      {"±", "$\\pm$"},    {"–", "--"},  {"−", "$-$"}, {"²", "$^2$"}, {"·", "$\\cdot$"},
      {"×", "$\\times$"}, {"%", "\\%"}, {"_", "\\_"}, {"&", "\\&"},  {">", "$>$"}};
  std::string result = text;
  for (const auto& [from, to] : replacements) {
    for (std::size_t at = result.find(from); at != std::string::npos;
         at = result.find(from, at + to.size())) {
      result.replace(at, from.size(), to);
    }
  }
  return result;
}

/// Titles and names come from files: raw HTML in them would be a part of the page. A < before a
/// number or a blank is only a sign.
std::string markdown_text(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char next = i + 1 < text.size() ? text[i + 1] : ' ';
    const bool opens_tag = std::isalpha(static_cast<unsigned char>(next)) != 0 || next == '/' ||
                           next == '!' || next == '?';
    if (text[i] == '<' && opens_tag) {
      result += "&lt;";
    } else if (text[i] == '\n' || text[i] == '\r') {
      result += ' ';
    } else {
      result += text[i];
    }
  }
  return result;
}

/// A | would end the cell.
std::string markdown_cell(const std::string& cell) {
  std::string text;
  for (const char c : markdown_text(cell)) text.append(c == '|' ? "\\|" : std::string(1, c));
  return text;
}

/// The conditions of one cell's scores, in words.
std::string how_scored(const Experiment& experiment, const noise::NoiseCell& cell) {
  return fmt::format("Both wheels; {}, {} noise seeds{}; {}; {}.", noise_text(cell),
                     experiment.noise.seeds, setup_caption(experiment), labels_text(experiment),
                     intervals_text(experiment));
}

}  // namespace

TextTable accuracy_table(const Experiment& experiment, const ScoreTables& tables,
                         const noise::NoiseCell& noise, const std::vector<std::string>& engines) {
  TextTable table{{"estimator"}, {}};
  for (const std::string& engine : engines) {
    table.header.insert(table.header.end(),
                        {engine + ": F1", "extra switches/min", "balanced accuracy"});
  }
  const Rows scores = wheels_at(tables.scores, noise);
  const auto silent = where(tables.cells.all(), [&](const TableRow& cell) {
    return is_at(cell, noise) && is_silent(cell);
  });
  const auto estimator_of = [](const TableRow& row) { return row.text("estimator"); };
  for (const std::string& estimator : unique(tables.cells.all(), estimator_of)) {
    std::vector<std::string>& row =
        table.rows.emplace_back(std::vector{estimator_title_in(experiment, estimator)});
    const auto is_own = [&](const TableRow& one) { return estimator_of(one) == estimator; };
    for (const std::string& simulator : experiment.simulators) {
      const Rows own = where(of_engine(scores, simulator), is_own);
      if (own.empty()) {
        row.insert(row.end(), 3, "–");
        continue;
      }
      const TableRow& score = own.front();
      row.push_back(with_interval(score.interval("event_f1")));
      const bool is_never_air = !where(of_engine(silent, simulator), is_own).empty();
      if (is_never_air && estimator != always_contact_name) row.back() += ", hardly any air";
      row.push_back(plain(score, "extra_switches_per_minute", "{:.1f}"));
      row.push_back(with_interval(score.interval("balanced_accuracy")));
    }
  }
  return table;
}

std::string summary_text(const ExperimentResult& result) {
  const Experiment& experiment = result.experiment;
  std::string text;
  for (const std::string& simulator : experiment.simulators) {
    const TestRuns runs = test_runs(result, simulator);
    if (runs.scored == 0) {
      text += fmt::format("\n{}: no test run stayed upright: nothing is scored\n", simulator);
      continue;
    }
    for (const noise::NoiseCell& cell : experiment.highlights) {
      text += fmt::format("\n{}: {} × {}, {}{}\n\n", simulator, text_of(runs),
                          plural(static_cast<std::size_t>(experiment.noise.seeds), "noise seed"),
                          noise_text(cell), setup_caption(experiment));
      text += to_text(cell_table(result, simulator, cell));
    }
    if (result.cells.size() > 1) {
      const std::string& first = experiment.estimators.front();
      text += fmt::format(
          "\n{}: success rate of {} by torque and accelerometer noise "
          "(* no better than always contact){}\n\n",
          simulator, estimator_title_in(experiment, first), setup_caption(experiment));
      text += to_text(grid_table(result.tables.cells, simulator, first, experiment.noise));
    }
  }
  if (experiment.paper_tables) {
    for (const CaptionedTable& table : paper_tables(result)) text += '\n' + to_text(table);
  }
  for (const std::string& study : result.studies) text += '\n' + study;
  const std::string notes = score_notes(experiment, result.tables);
  if (!notes.empty()) text += fmt::format("\n{}\n", notes);
  text += fmt::format("\n{}\n", conditions_text(experiment));
  return text + unused_runs_text(result.runs);
}

std::string closing_text(const ExperimentResult& result) {
  const Experiment& experiment = result.experiment;
  const noise::NoiseCell& cell = experiment.highlights.back();
  return fmt::format(
      "\nF1 of takeoffs and landings within 20 ms, {}{}\n\n{}", noise_text(cell),
      setup_caption(experiment),
      to_text(accuracy_table(experiment, result.tables, cell, experiment.simulators)));
}

std::vector<CaptionedTable> paper_tables(const Experiment& experiment, const ScoreTables& tables,
                                         const noise::NoiseCell& cell, const std::string& how) {
  const Rows scores = wheels_at(tables.scores, cell);
  return {
      {"Point-wise classification. " + how, "classification",
       table_of(
           experiment, scores,
           {"contact_precision", "contact_recall", "no_contact_precision", "no_contact_recall"},
           metric_cell, &PaperRow::classification)},
      {fmt::format(
           "Transitions. Switches within {:.0f} ms of a flight are no false alarms here, as "
           "they are for F1. {}",
           1e3 * experiment.scoring.hold_off, how),
       "transitions",
       table_of(experiment, scores,
                {"takeoff_precision", "takeoff_recall", "landing_precision", "landing_recall"},
                metric_cell, &PaperRow::transitions)},
      {"Latency of detected transitions (ms): mean ± standard deviation [interval of the mean]. " +
           how,
       "latency",
       table_of(experiment, scores, {"takeoff", "landing"}, latency_cell, &PaperRow::latency)},
  };
}

CaptionedTable difference_text_table(const Experiment& experiment, const ScoreTables& tables,
                                     const noise::NoiseCell& cell) {
  CaptionedTable result{"Paired differences",
                        "differences",
                        {{"simulator", "difference", "success rate", "no contact recall",
                          "takeoff precision", "takeoff latency (ms)", "landing latency (ms)"},
                         {}}};
  const Rows rows =
      where(tables.differences.all(), [&](const TableRow& row) { return is_at(row, cell); });
  const auto pair_of = [](const TableRow& row) {
    return std::array{row.text("simulator"), row.text("first"), row.text("second")};
  };
  for (const auto& [pair, metrics] : group_by(rows, pair_of)) {
    std::vector<std::string>& cells = result.table.rows.emplace_back(std::vector{
        pair[0],
        estimator_title_in(experiment, pair[1]) + " − " + estimator_title_in(experiment, pair[2])});
    for (const char* name : {"success", "no_contact_recall", "takeoff_precision",
                             "takeoff_latency_ms", "landing_latency_ms"}) {
      const auto metric = std::ranges::find_if(
          metrics, [&](const TableRow& row) { return row.text("metric") == name; });
      const int decimals = std::string_view(name).ends_with("_ms") ? 1 : 3;
      cells.push_back(
          metric == metrics.end() ? "–" : with_interval(metric->interval("difference"), decimals));
    }
  }
  return result;
}

/// The tables of each highlighted cell. From the second cell on, labels end with its number.
template <typename TablesOf>
static std::vector<CaptionedTable> of_highlights(const Experiment& experiment,
                                                 const TablesOf& tables_of) {
  std::vector<CaptionedTable> tables;
  for (std::size_t i = 0; i < experiment.highlights.size(); ++i) {
    std::vector<CaptionedTable> of_cell = tables_of(experiment.highlights[i]);
    for (CaptionedTable& table : of_cell) {
      if (i > 0) table.label += fmt::format("_{}", i + 1);
      tables.push_back(std::move(table));
    }
  }
  return tables;
}

std::vector<CaptionedTable> paper_tables(const ExperimentResult& result) {
  const Experiment& experiment = result.experiment;
  return of_highlights(experiment, [&](const noise::NoiseCell& cell) {
    std::vector<CaptionedTable> tables =
        paper_tables(experiment, result.tables, cell, how_scored(experiment, cell));
    tables.push_back(difference_text_table(experiment, result.tables, cell));
    tables.back().caption += setup_caption(experiment);
    return tables;
  });
}

std::vector<CaptionedTable> accuracy_tables(const ExperimentResult& result) {
  const Experiment& experiment = result.experiment;
  return of_highlights(experiment, [&](const noise::NoiseCell& cell) {
    return std::vector<CaptionedTable>{
        {"Success rate and false takeoffs. " + how_scored(experiment, cell), "accuracy",
         accuracy_table(experiment, result.tables, cell, experiment.simulators)}};
  });
}

std::string to_text(const CaptionedTable& table) {
  return table.caption + "\n\n" + to_text(table.table, 2);
}

std::string to_markdown(const CaptionedTable& table) {
  std::string text = markdown_text(table.caption) + "\n\n| " +
                     joined(table.table.header, " | ", markdown_cell) + " |\n|";
  for (std::size_t i = 0; i < table.table.header.size(); ++i) text += i < 2 ? "---|" : "---:|";
  text += "\n";
  for (const auto& row : table.table.rows) {
    text += "| " + joined(row, " | ", markdown_cell) + " |\n";
  }
  return text;
}

std::string to_latex(const CaptionedTable& table) {
  std::string columns(table.table.header.size(), 'l');
  for (std::size_t i = 0; i < columns.size() && !table.table.rows.empty(); ++i) {
    const std::string& cell = table.table.rows.front()[i];
    const bool is_word =
        !cell.empty() && std::isalpha(static_cast<unsigned char>(cell.front())) != 0;
    if (!is_word) columns[i] = 'r';
  }
  std::string text =
      fmt::format("% {}\n\\begin{{tabular}}{{{}}}\n\\toprule\n{} \\\\\n\\midrule\n", table.caption,
                  columns, joined(table.table.header, " & ", latex_text));
  for (const auto& row : table.table.rows) text += joined(row, " & ", latex_text) + " \\\\\n";
  return text + "\\bottomrule\n\\end{tabular}\n";
}

}  // namespace touchdown::experiments
