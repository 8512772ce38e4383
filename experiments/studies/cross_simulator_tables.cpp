#include <cmath>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "core/files.hpp"
#include "core/rows.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/estimators/baselines.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/results/captions.hpp"
#include "experiments/results/scores.hpp"
#include "experiments/results/text_tables.hpp"
#include "experiments/studies/cross_simulator.hpp"
#include "simulators/registry.hpp"

namespace touchdown::experiments {

namespace {

Columns<QuantityAgreement> agreement_columns(const std::vector<std::string>& engines) {
  return Columns<QuantityAgreement>()
      .text("quantity", &QuantityAgreement::name)
      .as("metric")
      .text("unit", &QuantityAgreement::unit)
      .interval(engines[0], &QuantityAgreement::first)
      .interval(engines[1], &QuantityAgreement::second)
      .interval("difference", &QuantityAgreement::difference);
}

Columns<TorqueAgreement> torque_columns() {
  return Columns<TorqueAgreement>()
      .text("torque", &TorqueAgreement::name)
      .interval("wasserstein_nm", &TorqueAgreement::distance)
      .interval("overlap", &TorqueAgreement::overlap)
      .metric("within_engine_nm", &TorqueAgreement::within_engine);
}

Columns<Verdict> verdict_columns() {
  return Columns<Verdict>()
      .text("estimator", &Verdict::estimator)
      .text("verdict", [](const Verdict& verdict) { return verdict.holds ? "holds" : "fails"; })
      .is(ColumnRole::note)
      .flag("demanded", &Verdict::is_demanded)
      .is(ColumnRole::note)
      .metric("loss_high", &Verdict::loss)
      .metric("gain_low", &Verdict::gain)
      .text("words", &Verdict::words)
      .is(ColumnRole::note);
}

Columns<CauseEffect> effect_columns() {
  return Columns<CauseEffect>()
      .text("quantity", [](const CauseEffect& e) { return name_of(e.quantity).title; })
      .as("metric")
      .text("unit", [](const CauseEffect& e) { return name_of(e.quantity).unit; })
      .text("cause", &CauseEffect::cause)
      .text("simulator", &CauseEffect::simulator)
      .interval("change", &CauseEffect::change)
      .text("convergence", &CauseEffect::convergence)
      .is(ColumnRole::note);
}

Columns<CauseCost> cost_columns() {
  return Columns<CauseCost>()
      .text("cause", &CauseCost::cause)
      .text("simulator", &CauseCost::simulator)
      .text("estimator", &CauseCost::estimator)
      .interval("cost", &CauseCost::cost);
}

CaptionedTable agreement_table(const CrossSimulatorResult& result) {
  const std::vector<std::string>& engine = result.experiment.simulators;
  CaptionedTable table{
      fmt::format("Agreement of the engines without estimators: the same {} runs in both{}.",
                  result.agreement.runs, setup_caption(result.experiment)),
      "agreement",
      {{"quantity", "unit", engine[0], engine[1], engine[1] + " − " + engine[0]}, {}}};
  for (const QuantityAgreement& q : result.agreement.quantities) {
    const int decimals = std::abs(q.first.estimate) >= 10.0 ? 1 : 3;
    table.table.rows.push_back({q.name, q.unit.empty() ? "–" : q.unit,
                                with_interval(q.first, decimals), with_interval(q.second, decimals),
                                with_interval(q.difference, decimals)});
  }
  return table;
}

CaptionedTable torque_table(const CrossSimulatorResult& result) {
  const Agreement& agreement = result.agreement;
  CaptionedTable table{
      fmt::format("Torque distributions of both engines; \"within\" is the distance between "
                  "even and odd runs of one engine{}.",
                  setup_caption(result.experiment)),
      "torques",
      {{"torque", "unit", "Wasserstein distance", "within", "overlap"}, {}}};
  for (const TorqueAgreement& t : agreement.torques) {
    table.table.rows.push_back({t.name, "N·m", with_interval(t.distance, 3),
                                fmt::format("{:.3f}", t.within_engine),
                                with_interval(t.overlap, 3)});
  }
  return table;
}

CaptionedTable transfer_table(const CrossSimulatorResult& result, const noise::NoiseCell& cell) {
  CaptionedTable table{
      fmt::format("Transfer: success rate by engine of the fit and of the test; its loss when "
                  "fitted in the other engine ({}{}).",
                  noise_text(cell), setup_caption(result.experiment)),
      "transfer",
      {{"estimator", "fit → test", "success rate", "no contact recall", "loss",
        "gain over always contact"},
       {}}};
  for (const TableRow& row : result.transfers.all()) {
    if (!is_at(row, cell)) continue;
    const std::string estimator = row.text("estimator");
    const std::string fit = row.text("fit_simulator"), test = row.text("test_simulator");
    const bool is_fitted = row.number("is_fitted") > 0.0;
    if (!is_fitted && fit != test) continue;
    table.table.rows.push_back(
        {estimator_entry(result.experiment, estimator).title,
         fmt::format("{} → {}", is_fitted ? fit : "–", test),
         with_interval(row.interval("success")), with_interval(row.interval("no_contact_recall")),
         fit == test ? "–" : with_interval(row.interval("loss"), 4),
         estimator == always_contact_name ? "–" : with_interval(row.interval("gain"))});
  }
  return table;
}

/// A row per quantity, a column per cause: what separates the engines, or half the step.
CaptionedTable effect_table(const CrossSimulatorResult& result, bool is_of_step) {
  const std::string caption =
      is_of_step
          ? "Change of each quantity by half the physics step; one that changes by more than the "
            "tolerance has not converged"
          : fmt::format(
                "Causes of the difference {} − {}: \"own laws\" is \"tyre\" plus "
                "\"solver\", which is left with one law; \"edge\" is Bullet's own radius",
                result.experiment.simulators[1], result.experiment.simulators[0]);
  const std::vector<CauseEffect> effects = where(result.causes.effects, [&](const CauseEffect& e) {
    return is_of_step ? e.tolerance.has_value() : e.simulator == "both" || e.cause == "edge";
  });
  return {fmt::format("{} ({} runs each{}).", caption, result.causes.runs,
                      setup_caption(result.experiment)),
          is_of_step ? "convergence" : "causes",
          pivot(
              effects,
              [](const CauseEffect& e) {
                const QuantityName& name = name_of(e.quantity);
                const std::string unit = *name.unit == 0 ? "" : fmt::format(" ({})", name.unit);
                const std::string limit =
                    e.tolerance ? fmt::format(", tolerance {}", exact(*e.tolerance)) : "";
                return name.title + unit + limit;
              },
              [](const CauseEffect& e) {
                return e.tolerance ? fmt::format("{}, {}", e.cause, e.simulator) : e.cause;
              },
              [](const CauseEffect& e) {
                const std::string change =
                    with_interval(e.change, std::abs(e.change.estimate) >= 10.0 ? 1 : 3);
                return e.convergence() == "not converged" ? change + " not converged" : change;
              })};
}

CaptionedTable cost_table(const CrossSimulatorResult& result) {
  return {
      fmt::format("Success rate that each cause costs estimators, fitted on the nominal scene of "
                  "the named engine ({}{}).",
                  noise_text(result.experiment.highlights.front()),
                  setup_caption(result.experiment)),
      "cause_costs",
      pivot(
          result.causes.costs,
          [](const CauseCost& c) { return fmt::format("{}, {}", c.cause, c.simulator); },
          [&](const CauseCost& c) { return estimator_entry(result.experiment, c.estimator).title; },
          [](const CauseCost& c) { return fmt::format("{:.4f}", c.cost.estimate); })};
}

std::string verdict_lines(const std::vector<Verdict>& verdicts, const char* bullet) {
  std::string text;
  for (const Verdict& verdict : verdicts) {
    text +=
        fmt::format("{}{}{}\n", bullet, verdict.is_demanded ? "[demanded] " : "", verdict.words);
  }
  return text;
}

/// The tables of the report: agreement, transfer, causes.
std::vector<CaptionedTable> report_tables(const CrossSimulatorResult& result) {
  std::vector<CaptionedTable> tables = {agreement_table(result), torque_table(result)};
  for (const noise::NoiseCell& cell : result.experiment.highlights) {
    tables.push_back(transfer_table(result, cell));
  }
  if (result.causes.runs > 0) {
    tables.insert(tables.end(),
                  {effect_table(result, false), effect_table(result, true), cost_table(result)});
  }
  return tables;
}

/// The series of a transfer: fitted in one engine and tested in the other.
FigureGroups directions(const Experiment& experiment) {
  FigureGroups groups{{"fit_simulator", "test_simulator"}, {}};
  for (const std::string& fit : experiment.simulators) {
    for (const std::string& test : experiment.simulators) {
      if (fit == test) continue;
      groups.groups.push_back({{fit, test},
                               fmt::format("{} → {}", simulators::simulator_title(fit),
                                           simulators::simulator_title(test))});
    }
  }
  return groups;
}

FigureSpec transfer_figure(const Table& transfer, const Experiment& experiment) {
  FigureSpec spec{.name = "transfer", .table = "transfer.csv"};
  spec.where = {{"is_fitted", "1"}};
  spec.panels = noise_panels(transfer);
  spec.series = directions(experiment);
  spec.rows = groups_in(transfer, "estimator", titles_in(experiment), spec.where);
  spec.measures = {axis_with_interval("loss", "loss of success rate"),
                   axis_with_interval("gain", "gain over always contact")};
  spec.title = "Transfer between the engines";
  spec.caption = fmt::format(
      "Estimators fitted in one engine and tested in the other, \"fitted → tested\". Loss: "
      "success rate of the same estimator fitted in the test engine, minus this one's, on the same "
      "runs. Gain: "
      "success rate minus that of always contact ({}{}; {}).",
      labels_text(experiment), setup_caption(experiment), intervals_text(experiment));
  spec.alt = "Loss of success rate when fitted in the other engine." + values_text(spec, transfer);
  return spec;
}

}  // namespace

StudyResult summarize_check(const CrossSimulatorResult& result, const RunDirectory& directory) {
  const Experiment& experiment = result.experiment;
  directory.write_table("agreement.csv", agreement_columns(experiment.simulators),
                        result.agreement.quantities);
  directory.write_table("torques.csv", torque_columns(), result.agreement.torques);
  directory.write_measured("transfer.csv", result.transfers);
  if (result.causes.runs > 0) {
    directory.write_table("causes.csv", effect_columns(), result.causes.effects);
    directory.write_table("cause_costs.csv", cost_columns(), result.causes.costs);
  }
  directory.write_table("verdicts.csv", verdict_columns(), result.verdicts);
  std::string text;
  std::string markdown;
  for (const CaptionedTable& table : report_tables(result)) {
    text += '\n' + to_text(table);
    markdown += to_markdown(table) + "\n";
  }
  text += "\nVerdicts\n\n" + verdict_lines(result.verdicts, "  ");
  markdown += "Verdicts\n\n" + verdict_lines(result.verdicts, "- ");
  write_atomically(directory.own_file("tables", "cross_simulator.md"), markdown);
  return {{std::move(text)},
          failed_demands(result.verdicts),
          {transfer_figure(result.transfers, experiment)}};
}

}  // namespace touchdown::experiments
