#include "render/report/findings.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "experiments/config/experiment_estimators.hpp"
#include "experiments/estimators/baselines.hpp"
#include "experiments/results/captions.hpp"
#include "render/figures/error_scale.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {
namespace {

using Cells = std::vector<experiments::CellSummary>;

/// "knee torques, wheel torques and the accelerometer"; "no noisy signal".
std::string inputs_text(const experiments::Sensors& sensors) {
  std::vector<std::string> inputs;
  if (sensors.hip_torque) inputs.emplace_back("hip torques");
  if (sensors.knee_torque) inputs.emplace_back("knee torques");
  if (sensors.wheel_torque) inputs.emplace_back("wheel torques");
  if (sensors.acceleration) inputs.emplace_back("the accelerometer");
  if (sensors.joint_position) inputs.emplace_back("joint angles");
  if (sensors.joint_velocity) inputs.emplace_back("joint velocities");
  return inputs.empty() ? "no noisy signal" : in_words(inputs);
}

/// The estimators' scores in one engine and noise cell, the fewest errors first.
Cells ranked(const Cells& all, const std::string& simulator, const noise::NoiseCell& noise) {
  Cells cells;
  std::copy_if(all.begin(), all.end(), std::back_inserter(cells),
               [&](const experiments::CellSummary& cell) {
                 return cell.condition.test_simulator == simulator && cell.cell == noise &&
                        cell.condition.estimator != experiments::always_contact_name &&
                        std::isfinite(cell.success.estimate);
               });
  std::stable_sort(cells.begin(), cells.end(), [](const auto& a, const auto& b) {
    return a.success.estimate > b.success.estimate;
  });
  return cells;
}

std::string title_of(const experiments::CellSummary& cell) {
  return experiments::estimator_title(cell.condition.estimator);
}

/// The error rate; a line cannot break before its percent sign.
std::string error_of(double accuracy) { return error_text(error_percent(accuracy)) + "\u00a0%"; }

/// "Without noise, Phase filter has the lowest error rate, 0.94 % [0.80, 1.10], ahead of Free fall
/// (1.59 %) and NMN (2.87 %). …"
std::string finding(const Cells& cells) {
  const experiments::CellSummary& best = cells.front();
  const bool is_noiseless = best.cell.torque == 0.0 && best.cell.accelerometer == 0.0;
  std::vector<std::string> next, losers;
  for (const experiments::CellSummary& cell : cells) {
    if (&cell != &best && next.size() < 2) {
      next.push_back(fmt::format("{} ({})", title_of(cell), error_of(cell.success.estimate)));
    }
    if (cell.loses()) losers.push_back(title_of(cell));
  }
  std::string text = fmt::format(
      "{}, {} has the lowest error rate, {} [{}, {}]{}. ",
      is_noiseless ? "Without noise" : "With " + experiments::noise_text(best.cell), title_of(best),
      error_of(best.success.estimate), error_text(error_percent(best.success.high)),
      error_text(error_percent(best.success.low)),
      next.empty() ? "" : ", ahead of " + in_words(next));
  if (!std::isfinite(best.always_contact)) return text;
  return text + fmt::format("Always contact has an error rate of {}{}. ",
                            error_of(best.always_contact),
                            losers.empty() ? ""
                                           : fmt::format("; {} {} not beat it", in_words(losers),
                                                         losers.size() > 1 ? "do" : "does"));
}

}  // namespace

ReportSection estimators_section(const ReportSubject& subject) {
  ReportSection section{"estimators", "Estimators", "<dl class=\"estimators\">\n"};
  for (const std::string& name : subject.experiment.estimators) {
    const experiments::EstimatorEntry& entry =
        experiments::estimator_entry(subject.experiment, name);
    section.html += fmt::format("<dt>{}</dt><dd>{}. It uses {}.</dd>\n", escaped(entry.title),
                                escaped(entry.summary), escaped(inputs_text(entry.sensors)));
  }
  section.html += "</dl>\n";
  return section;
}

std::string findings_html(const ReportSubject& subject) {
  const Cells& all = subject.summary.cells;
  if (all.empty()) return {};
  std::vector<noise::NoiseCell> settings = subject.experiment.highlights;
  if (settings.empty()) settings.push_back(all.front().cell);
  std::string html;
  for (const std::string& simulator : subject.experiment.simulators) {
    std::string text;
    for (const noise::NoiseCell& noise : settings) {
      const Cells cells = ranked(all, simulator, noise);
      if (!cells.empty()) text += finding(cells);
    }
    if (text.empty()) continue;
    text.pop_back();
    html += fmt::format("<p><b>{}.</b> {}</p>\n", escaped(simulators::simulator_title(simulator)),
                        escaped(text));
  }
  return html;
}

}  // namespace touchdown::render
