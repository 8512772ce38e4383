#include "experiments/studies/cross_simulator/tables.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/files.hpp"
#include "experiments/config/experiment_estimators.hpp"
#include "experiments/estimators/baselines.hpp"
#include "experiments/results/captions.hpp"

namespace touchdown::experiments {

namespace {

Table agreement_csv(const CrossSimulatorResult& result) {
  const std::vector<std::string>& engine = result.experiment.simulators;
  Table table{header_with_intervals({"quantity", "unit"}, {engine[0], engine[1], "difference"}),
              {}};
  for (const QuantityAgreement& q : result.agreement.quantities) {
    table.rows.push_back(row_with_intervals({q.name, q.unit}, {q.first, q.second, q.difference}));
  }
  return table;
}

Table torques_csv(const Agreement& agreement) {
  Table table{
      header_with_intervals({"torque"}, {"wasserstein_nm", "overlap"}, {"within_engine_nm"}), {}};
  for (const TorqueAgreement& t : agreement.torques) {
    table.rows.push_back(
        row_with_intervals({t.name}, {t.distance, t.overlap}, {metric(t.within_engine)}));
  }
  return table;
}

Table transfer_csv(const std::vector<Transfer>& transfers) {
  Table table{header_with_intervals({"torque_noise_nm", "accelerometer_noise_mps2", "estimator",
                                     "fit_simulator", "test_simulator", "is_fitted"},
                                    {"success", "no_contact_recall", "loss", "gain"}),
              {}};
  for (const Transfer& t : transfers) {
    table.rows.push_back(row_with_intervals(
        {exact(t.cell.torque), exact(t.cell.accelerometer), t.condition.estimator,
         t.condition.fit_simulator, t.condition.test_simulator, t.is_fitted ? "1" : "0"},
        {t.success, t.no_contact_recall, t.loss, t.gain}));
  }
  return table;
}

Table sensitivity_csv(const std::vector<Sensitivity>& sensitivities) {
  Table table{
      header_with_intervals(
          {"factor", "value", "nominal", "simulator", "estimator", "runs", "failed"}, {"success"}),
      {}};
  for (const Sensitivity& s : sensitivities) {
    table.rows.push_back(row_with_intervals(
        {s.variation.factor, exact(s.variation.value), exact(s.variation.nominal),
         s.variation.simulator, s.estimator, std::to_string(s.runs), std::to_string(s.failed)},
        {s.success}));
  }
  return table;
}

Table verdicts_csv(const std::vector<Verdict>& verdicts) {
  Table table{{"estimator", "verdict", "demanded", "loss_high", "gain_low", "words"}, {}};
  for (const Verdict& v : verdicts) {
    table.rows.push_back({v.estimator, v.holds ? "holds" : "fails", v.is_demanded ? "1" : "0",
                          metric(v.loss), metric(v.gain), v.words});
  }
  return table;
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
      fmt::format("Transfer: accuracy by engine of the fit and of the test; loss of accuracy when "
                  "fitted in the other engine ({}{}).",
                  noise_text(cell), setup_caption(result.experiment)),
      "transfer",
      {{"estimator", "fit → test", "accuracy", "no contact recall", "loss",
        "gain over always contact"},
       {}}};
  for (const Transfer& t : result.transfers) {
    if (!(t.cell == cell)) continue;
    const bool own = t.condition.fit_simulator == t.condition.test_simulator;
    if (!t.is_fitted && !own) continue;
    const std::string where = t.is_fitted
                                  ? t.condition.fit_simulator + " → " + t.condition.test_simulator
                                  : "– → " + t.condition.test_simulator;
    table.table.rows.push_back(
        {estimator_entry(result.experiment, t.condition.estimator).title, where,
         with_interval(t.success), with_interval(t.no_contact_recall),
         own ? "–" : with_interval(t.loss, 4),
         t.condition.estimator == always_contact_name ? "–" : with_interval(t.gain)});
  }
  return table;
}

/// One row per value and engine, one column per estimator.
CaptionedTable sensitivity_table(const CrossSimulatorResult& result) {
  CaptionedTable table{
      fmt::format("Sensitivity: accuracy of estimators fitted on the nominal scene (*), one "
                  "factor at a time, {} runs each ({}{}).",
                  result.experiment.cross_simulator->sensitivity_runs,
                  noise_text(result.experiment.highlights.front()),
                  setup_caption(result.experiment)),
      "sensitivity",
      {{"factor", "simulator", "value", "fell"}, {}}};
  std::string last;
  for (const Sensitivity& s : result.sensitivities) {
    const std::string key =
        fmt::format("{} {} {}", s.variation.factor, s.variation.simulator, s.variation.value);
    if (key != last) {
      table.table.rows.push_back(
          {s.variation.factor, s.variation.simulator,
           exact(s.variation.value) + (s.variation.value == s.variation.nominal ? " *" : ""),
           fmt::format("{}/{}", s.failed, s.runs + s.failed)});
    }
    last = key;
    if (table.table.rows.size() == 1) {
      table.table.header.push_back(estimator_entry(result.experiment, s.estimator).title);
    }
    table.table.rows.back().push_back(
        std::isnan(s.success.estimate) ? "–" : fmt::format("{:.3f}", s.success.estimate));
  }
  return table;
}

std::string verdict_lines(const std::vector<Verdict>& verdicts, const char* bullet) {
  std::string text;
  for (const Verdict& verdict : verdicts) {
    text +=
        fmt::format("{}{}{}\n", bullet, verdict.is_demanded ? "[demanded] " : "", verdict.words);
  }
  return text;
}

}  // namespace

std::vector<CaptionedTable> report_tables(const CrossSimulatorResult& result) {
  std::vector<CaptionedTable> tables = {agreement_table(result), torque_table(result)};
  for (const noise::NoiseCell& cell : result.experiment.highlights) {
    tables.push_back(transfer_table(result, cell));
  }
  if (!result.sensitivities.empty()) tables.push_back(sensitivity_table(result));
  return tables;
}

std::string report_text(const CrossSimulatorResult& result) {
  std::string text;
  for (const CaptionedTable& table : report_tables(result)) text += '\n' + to_text(table);
  return text + "\nVerdicts\n\n" + verdict_lines(result.verdicts, "  ");
}

void write_tables(const CrossSimulatorResult& result, const RunDirectory& directory) {
  directory.write_table("agreement.csv", agreement_csv(result));
  directory.write_table("torques.csv", torques_csv(result.agreement));
  directory.write_table("transfer.csv", transfer_csv(result.transfers));
  directory.write_table("sensitivity.csv", sensitivity_csv(result.sensitivities));
  directory.write_table("verdicts.csv", verdicts_csv(result.verdicts));
  std::string markdown;
  for (const CaptionedTable& table : report_tables(result)) markdown += to_markdown(table) + "\n";
  markdown += "Verdicts\n\n" + verdict_lines(result.verdicts, "- ");
  write_atomically(directory.file("tables", "cross_simulator.md"), markdown);
}

}  // namespace touchdown::experiments
