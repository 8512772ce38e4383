#include "experiments/studies/odometry/figures.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include <fmt/format.h>

#include "experiments/figures/groups.hpp"
#include "experiments/results/odometry.hpp"
#include "simulators/registry.hpp"

namespace touchdown::experiments {

namespace {

/// The contact sources by their mean error over scenes and engines, the best first.
FigureGroups ranked_contacts(const Table& odometry, const FigureSpec& spec) {
  std::map<std::string, double> sums;
  for (const std::vector<std::string>& row : odometry.rows) {
    const double error = drawn_value(spec.measures.front(), cell(odometry, row, "rms_m"));
    if (!passes(odometry, row, spec.where) || std::isnan(error)) continue;
    sums[cell(odometry, row, "contact")] += error;
  }
  FigureGroups contacts = groups_in(odometry, "contact", contact_title, spec.where);
  std::stable_sort(contacts.groups.begin(), contacts.groups.end(),
                   [&](const FigureGroup& a, const FigureGroup& b) {
                     return sums[a.values.front()] < sums[b.values.front()];
                   });
  return contacts;
}

}  // namespace

std::vector<FigureSpec> odometry_figures(const Table& odometry, const Experiment& experiment) {
  const FigureGroups setups =
      combinations_in(odometry, {"robot", "sensors"}, [](const auto&) { return std::string(); });
  std::vector<FigureSpec> specs;
  for (const FigureGroup& setup : setups.groups) {
    const std::string& robot = setup.values[0];
    const std::string& sensors = setup.values[1];
    FigureSpec spec;
    spec.name = fmt::format("odometry_{}_{}", robot, sensors);
    spec.table = "odometry.csv";
    spec.where = {{"robot", robot}, {"sensors", sensors}};
    spec.measures = {{.column = "rms_m",
                      .title = "RMS error",
                      .unit = "m",
                      .low = "rms_m_low",
                      .high = "rms_m_high",
                      .from = 0.0}};
    spec.panels = groups_in(
        odometry, "scenario", [](const auto& scene) { return scene; }, spec.where);
    spec.series = groups_in(odometry, "simulator", simulators::simulator_title, spec.where);
    spec.rows = ranked_contacts(odometry, spec);
    spec.title = fmt::format("Odometry error by contact source: {}, {} sensors", robot, sensors);
    spec.caption = fmt::format(
        "Root mean square error of the horizontal position along the run, starting from the true "
        "pose, with {:.0f} % bootstrap intervals over runs. All sources use the same filter and "
        "the same sensors. Oracles repeat the true contact, with or without a delay.",
        100.0 * experiment.intervals.bootstrap.level);
    spec.alt = "Root mean square error of odometry." + values_text(spec, odometry);
    specs.push_back(std::move(spec));
  }
  return specs;
}

}  // namespace touchdown::experiments
