#include "apps/viewer/live_controls.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "logs/log/recording_file.hpp"
#include "scenarios/scenario.hpp"

namespace touchdown::viewer {

namespace {

constexpr double slowest = 1.0 / 64, fastest = 4.0;

/// `run.mpack`, then `run_2.mpack`, …
std::filesystem::path numbered(const std::filesystem::path& path, std::size_t number) {
  if (number == 1) return path;
  std::filesystem::path result = path;
  result.replace_filename(
      fmt::format("{}_{}{}", path.stem().string(), number, path.extension().string()));
  return result;
}

}  // namespace

LiveRange range_of(LiveNumber number) {
  constexpr std::array<LiveRange, live_numbers> ranges = {
      LiveRange{0.25, 10.0} /* N·m */, LiveRange{1.0, 50.0} /* m/s² */, LiveRange{0.01, 0.2} /* s */
  };
  return ranges[static_cast<std::size_t>(number)];
}

LiveControls::LiveControls(LiveRequest request, std::function<void()> started)
    : request_(std::move(request)), started_(std::move(started)), loop_(make_run()) {
  for (const auto& [name, profile] : request_.sensors) sensor_names_.push_back(name);
  take_over();
}

std::unique_ptr<LiveRun> LiveControls::make_run() {
  return std::make_unique<LiveRun>(request_.scene, request_.estimators, settings_,
                                   !request_.record.empty());
}

/// Takes over what the run in the loop consists of.
void LiveControls::take_over() {
  estimators_.clear();
  loop_.use([&](const LiveRun& run) {
    simulator_ = &run.simulator();
    for (const LiveEstimator& estimator : run.estimators()) estimators_.push_back(estimator.title);
    sources_ = run.contact_sources();
    settings_ = run.settings();
  });
}

/// The settings that a number sets, all of them alike.
static std::vector<double*> members_of(LiveSettings& settings, LiveNumber number) {
  noise::SensorNoise& noise = settings.noise;
  if (number == LiveNumber::contact_delay) return {&settings.contact_delay};
  if (number == LiveNumber::acceleration_noise) return {&noise.acceleration};
  return {&noise.knee_torque, &noise.hip_torque, &noise.wheel_torque};
}

double LiveControls::value(LiveNumber number) const {
  LiveSettings settings = settings_;
  return *members_of(settings, number).front();
}

void LiveControls::set(LiveNumber number, double value) {
  value = std::clamp(value, 0.0, range_of(number).most);
  change([&](LiveSettings& settings) {
    for (double* const member : members_of(settings, number)) *member = value;
  });
}

void LiveControls::change(const std::function<void(LiveSettings&)>& action) {
  action(settings_);
  loop_.use([&](LiveRun& run) {
    run.change(settings_);
    settings_ = run.settings();
  });
}

void LiveControls::pause(bool paused) {
  is_paused_ = paused;
  loop_.set_paused(paused);
}

void LiveControls::step(int count) {
  if (!is_paused_) pause(true);
  loop_.step(count);
}

void LiveControls::scale_speed(double factor) {
  speed_ = std::clamp(factor * speed_, slowest, fastest);
  loop_.set_speed(speed_);
}

void LiveControls::restart() {
  save();
  const std::unique_ptr<LiveRun> old = loop_.replace(make_run());
  take_over();
  started_();
}

void LiveControls::start_next_draw() {
  ++request_.scene.run;
  restart();
}

void LiveControls::change_engine() {
  request_.scene.engine = request_.scene.engine == "mujoco" ? "bullet" : "mujoco";
  restart();
}

void LiveControls::choose_contact_source(std::size_t index) {
  change([&](LiveSettings& settings) { settings.contact_source = index; });
}

void LiveControls::choose_sensors(std::size_t index) {
  sensors_ = index;
  change([&](LiveSettings& settings) { settings.sensors = request_.sensors[index].second; });
}

void LiveControls::save() {
  if (request_.record.empty()) return;
  std::optional<logs::Recording> recording;
  scenarios::End end;
  loop_.use([&](const LiveRun& run) {
    recording = run.recording();
    end = run.scene().scenario.end;
  });
  if (recording->steps() == 0) return;
  const auto path = numbered(request_.record, saved_.size() + 1);
  logs::write_recording(*recording, path);
  saved_.push_back(fmt::format("{}: {}", path.string(), scenarios::ending_text(*recording, end)));
}

}  // namespace touchdown::viewer
