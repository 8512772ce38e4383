#include "experiments/studies/benchmark/unseen_table.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiments/estimators/registry.hpp"
#include "experiments/studies/benchmark/config.hpp"

namespace touchdown::experiments {

namespace {

/// ".989", "1".
std::string share_text(double share) {
  if (std::isnan(share)) return "–";
  const std::string text = fmt::format("{:.3f}", share);
  return text.starts_with("0.") ? text.substr(1) : text == "1.000" ? "1" : text;
}

std::string share_text(const Interval& share) {
  if (std::isnan(share.low) || std::isnan(share.high)) return share_text(share.estimate);
  return fmt::format("{} [{}, {}]", share_text(share.estimate), share_text(share.low),
                     share_text(share.high));
}

std::string header_of(const noise::NoiseCell& noise) {
  if (noise.levels() == noise::SensorNoise{}) return "no added noise";
  return noise.knee == noise.wheel ? fmt::format("{} N·m, {} m/s²", noise.knee, noise.accelerometer)
                                   : fmt::format("knee {} N·m, wheel {} N·m, {} m/s²", noise.knee,
                                                 noise.wheel, noise.accelerometer);
}

const Standings::Entry* entry_called(const std::string& estimator, const Standings& standings) {
  const auto found =
      std::find_if(standings.entries.begin(), standings.entries.end(),
                   [&](const Standings::Entry& entry) { return entry.estimator == estimator; });
  return found == standings.entries.end() ? nullptr : &*found;
}

/// Those of `benchmark.table`, or all that are ranked, the best first.
std::vector<std::string> estimators_of(const Standings& first, const Experiment& experiment) {
  std::vector<std::string> all = experiment.studies.at<BenchmarkConfig>().table;
  if (!all.empty()) return all;
  for (const Standings::Entry& entry : first.entries) {
    if (!is_upper_bound(entry.estimator)) all.push_back(entry.estimator);
  }
  return all;
}

}  // namespace

std::string unseen_markdown(const std::vector<Standings>& unseen, const Experiment& experiment) {
  if (unseen.empty()) return {};
  const Standings& first = unseen.front();
  std::vector<const Standings*> settings;
  for (const Standings& one : unseen) {
    if (one.robot == first.robot && one.sensors == first.sensors) settings.push_back(&one);
  }
  std::string text = "| estimator |";
  std::string line = "|---|";
  for (const Standings* one : settings) {
    text += fmt::format(" {} |", header_of(one->noise));
    line += "---|";
  }
  text += " extra switches a minute |\n" + line + "---|\n";
  for (const std::string& estimator : estimators_of(first, experiment)) {
    std::string accuracy;
    std::vector<std::string> switches;
    for (const Standings* one : settings) {
      const Standings::Entry* entry = entry_called(estimator, *one);
      accuracy += fmt::format(" {} |", entry == nullptr ? "–" : share_text(entry->mean));
      switches.push_back(entry == nullptr ? "–" : fmt::format("{:.1f}", entry->extra_switches));
    }
    text += fmt::format("| `{}` |{} {} |\n", estimator, accuracy, fmt::join(switches, " / "));
  }
  return text;
}

}  // namespace touchdown::experiments
