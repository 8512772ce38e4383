#include "render/film/request.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.hpp"
#include "scoring/transitions.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {

std::vector<std::uint8_t> wheels_in_contact(const logs::Recording& recording,
                                            const scoring::LabelConfig& labels) {
  if (recording.truth.size() < recording.steps()) return {};
  const auto wheels = scoring::contact_labels(recording, labels);
  std::vector<std::uint8_t> count(wheels[0].size());
  for (std::size_t k = 0; k < count.size(); ++k) {
    count[k] = static_cast<std::uint8_t>((wheels[0][k] != 0 ? 1 : 0) + (wheels[1][k] != 0 ? 2 : 0));
  }
  return count;
}

std::vector<WheelFlight> wheel_flights(const logs::Recording& recording,
                                       const scoring::LabelConfig& labels) {
  if (recording.truth.size() < recording.steps()) return {};
  const double period = recording.period();
  const auto shortest =
      static_cast<std::size_t>(std::llround(scoring::ScoringConfig{}.minimum_flight / period));
  const auto contact = scoring::contact_labels(recording, labels);
  std::vector<WheelFlight> all;
  for (std::size_t wheel = 0; wheel < contact.size(); ++wheel) {
    for (const scoring::Flight& flight : scoring::flights(contact[wheel], shortest)) {
      all.push_back({wheel, period * static_cast<double>(flight.takeoff),
                     period * static_cast<double>(flight.landing),
                     flight.takeoff > 0 && flight.landing < recording.steps()});
    }
  }
  std::ranges::stable_sort(all, {}, &WheelFlight::takeoff);
  return all;
}

std::string label_of(const VideoSource& source) {
  if (!source.label.empty()) return source.label;
  const std::string& name = source.recording.info.simulator;
  return name.empty() ? "robot log" : simulators::simulator_title(name);
}

VideoOptions film_of_width(double width, double ratio) {
  VideoOptions options;
  options.width = 2 * static_cast<int>(std::lround(width / 2.0));
  options.height = 2 * static_cast<int>(std::lround(width * ratio / 2.0));
  return options;
}

void require_drawable(const std::vector<VideoSource>& sources, const VideoOptions& options) {
  if (options.width < 160 || options.height < 120 || options.width > 7680 ||
      options.height > 4320 || options.width % 2 != 0 || options.height % 2 != 0) {
    throw InputError(fmt::format("a video of {}x{}: expected even numbers, 160x120 to 7680x4320",
                                 options.width, options.height));
  }
  if (options.fps < 1 || options.fps > 1000) {
    throw InputError(fmt::format("{} frames per second: expected 1 to 1000", options.fps));
  }
  if (!(options.speed > 0.0) || !std::isfinite(options.speed)) {
    throw InputError(fmt::format("speed {}: expected a number above 0", options.speed));
  }
  if (sources.size() > most_sources) {
    throw InputError(
        fmt::format("a film of {} runs: expected at most {}", sources.size(), most_sources));
  }
  for (const VideoSource& source : sources) {
    if (source.recording.steps() == 0) {
      throw InputError("the recording is empty: there is nothing to draw");
    }
    for (const BeliefTrack& belief : source.beliefs) {
      for (const auto* wheels : {&belief.p_contact, &belief.p_takeoff, &belief.p_landing}) {
        for (const std::vector<float>& values : *wheels) {
          if (values.empty() || values.size() == source.recording.steps()) continue;
          throw InputError(fmt::format("estimator '{}' has {} values for {} rows of the recording",
                                       belief.name, values.size(), source.recording.steps()));
        }
      }
    }
  }
}

}  // namespace touchdown::render
