#include "render/mcap/scene.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "recordings/log/mcap.hpp"
#include "render/film/pose.hpp"
#include "render/mcap/messages.hpp"
#include "scenarios/ending.hpp"
#include "scoring/labels.hpp"

namespace touchdown::render {

namespace {

constexpr double transform_period = 0.02;  // s
constexpr int information = 2, warning = 3;

struct LogEvent {
  std::string name, message;
  int level;
};

/// True takeoffs and landings of both wheels by row, and how the run ended.
std::multimap<std::size_t, LogEvent> events_of(const recordings::Recording& recording) {
  std::multimap<std::size_t, LogEvent> events;
  if (recording.truth.size() < recording.steps()) return events;
  const auto contact = scoring::contact_labels(recording, {});
  for (std::size_t wheel = 0; wheel < contact.size(); ++wheel) {
    const char* const side = wheel == 0 ? "left" : "right";
    for (const scoring::Flight& flight : scoring::flights(contact[wheel])) {
      if (flight.takeoff > 0) {
        events.insert({flight.takeoff,
                       {"ground truth", fmt::format("{} wheel takes off", side), information}});
      }
      if (flight.landing < recording.steps()) {
        const double time =
            recording.period() * static_cast<double>(flight.landing - flight.takeoff);
        events.insert(
            {flight.landing,
             {"ground truth", fmt::format("{} wheel lands after {:.0f} ms", side, 1e3 * time),
              information}});
      }
    }
  }
  if (recording.info.outcome) {
    const bool is_finished = *recording.info.outcome == recordings::Outcome::finished;
    events.insert({recording.steps() - 1,
                   {"run", scenarios::outcome_text(*recording.info.outcome),
                    is_finished ? information : warning}});
  }
  return events;
}

}  // namespace

std::uint64_t write_mcap_with_scene(recordings::LogReader& reader, std::ostream& stream,
                                    const models::RobotModel& robot,
                                    const recordings::Recording& recording) {
  const Poses poses(robot, recording);
  const models::MjDataPtr data(mj_makeData(robot.mj.get()));
  const auto events = events_of(recording);
  const auto every =
      static_cast<std::size_t>(std::max(1L, std::lround(transform_period / recording.period())));
  std::uint16_t of_transforms = 0;
  std::uint16_t of_events = 0;
  return recordings::write_mcap(
      reader, stream, [&](recordings::McapWriter& writer, std::uint64_t row, std::uint64_t time) {
        if (row >= poses.count()) return;
        if (row % every == 0) {
          poses.apply(row, *data);
          const std::string transforms = frame_transforms(*robot.mj, *data, time).dump();
          if (row == 0) {
            const std::string scene = scene_update(*robot.mj, time).dump();
            writer.write(writer.add_topic(mcap_scene_topic, "foxglove.SceneUpdate",
                                          recordings::json_schema_of(scene)),
                         time, scene);
            of_transforms = writer.add_topic(mcap_transforms_topic, "foxglove.FrameTransforms",
                                             recordings::json_schema_of(transforms));
            of_events = writer.add_topic(
                mcap_events_topic, "foxglove.Log",
                recordings::json_schema_of(log_message("", "", information, time).dump()));
          }
          writer.write(of_transforms, time, transforms);
        }
        const auto [begin, end] = events.equal_range(row);
        for (auto event = begin; event != end; ++event) {
          const auto& [name, message, level] = event->second;
          writer.write(of_events, time, log_message(name, message, level, time).dump());
        }
      });
}

}  // namespace touchdown::render
