#include "render/film/source.hpp"

#include "simulators/registry.hpp"

namespace touchdown::render {

std::vector<std::uint8_t> wheels_in_contact(const recordings::Recording& recording,
                                            const scoring::LabelConfig& labels) {
  if (recording.truth.size() < recording.steps()) return {};
  const auto wheels = scoring::contact_labels(recording, labels);
  std::vector<std::uint8_t> count(wheels[0].size());
  for (std::size_t k = 0; k < count.size(); ++k) {
    count[k] = static_cast<std::uint8_t>((wheels[0][k] != 0) + (wheels[1][k] != 0));
  }
  return count;
}

std::string engine_label(const recordings::Recording& recording) {
  const std::string& name = recording.info.simulator;
  return name.empty() ? "robot log" : simulators::simulator_title(name);
}

}  // namespace touchdown::render
