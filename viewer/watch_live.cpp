#include "viewer/watch_live.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "recordings/log/recording_file.hpp"
#include "scenarios/ending.hpp"
#include "viewer/live/real_time.hpp"
#include "viewer/screen/keys.hpp"
#include "viewer/screen/live_plots.hpp"
#include "viewer/screen/panel.hpp"
#include "viewer/screen/screen.hpp"

namespace touchdown::viewer {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double velocity_step = 0.1, largest_velocity = 1.5;           // m/s
constexpr double yaw_rate_step = 0.2, largest_yaw_rate = 2.0;           // rad/s
constexpr double crouch_step = 0.1, largest_crouch = 1.2;               // rad
constexpr double torque_step = 0.25, largest_torque = 10.0;             // N·m
constexpr double acceleration_step = 1.0, largest_acceleration = 50.0;  // m/s²
constexpr double delay_step = 0.01, largest_delay = 0.2;                // s
constexpr double slowest = 1.0 / 64, fastest = 4.0;
constexpr double vector_length = 0.01;  // m per N

double stepped(double value, const KeyPress& press, double step, double least, double most) {
  return std::clamp(value + (press.shift ? -step : step), least, most);
}

/// `run.mpack`, then `run_2.mpack`, …
std::filesystem::path numbered(const std::filesystem::path& path, int number) {
  if (number == 1) return path;
  std::filesystem::path result = path;
  result.replace_filename(
      fmt::format("{}_{}{}", path.stem().string(), number, path.extension().string()));
  return result;
}

/// A window in which a user watches and drives a live run.
class LiveWindow {
 public:
  explicit LiveWindow(LiveRequest request)
      : request_(std::move(request)),
        window_("touchdown: " + request_.scene.scenario.name, request_.width, request_.height),
        screen_(window_),
        settings_(request_.settings),
        loop_(make_run()) {
    show_run();
    bind_keys();
  }

  LiveSession watch(const std::atomic<bool>& stop) {
    const Clock::time_point start = Clock::now();
    Clock::time_point last = start;
    while (window_.is_open() && !stop) {
      const Clock::time_point now = Clock::now();
      draw(std::chrono::duration<double>(now - last).count());
      last = now;
      ++session_.frames;
      const WindowInput input = window_.take_input();
      act_on(bindings_, input.keys);
      use_mouse(input.mouse);
      std::this_thread::sleep_until(now + shortest_frame);
    }
    session_.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    save();
    return std::move(session_);
  }

 private:
  std::unique_ptr<LiveRun> make_run() {
    return std::make_unique<LiveRun>(request_.scene, request_.estimators, settings_,
                                     !request_.record.empty());
  }

  /// Makes screen and curves anew for the run in the loop.
  void show_run() {
    std::vector<std::string> names;
    loop_.use([&](const LiveRun& run) {
      const simulators::Simulator& simulator = run.simulator();
      robot_ = &simulator.model();
      for (const LiveEstimator& estimator : run.estimators()) names.push_back(estimator.title);
      sources_ = run.contact_sources();
      settings_ = run.settings();
      constexpr double gravity = 9.81;
      plots_.emplace(names.size(), LiveRun::sample_steps * simulator.control_period(),
                     gravity * robot_->mj->body_subtreemass[0]);
    });
    names_ = std::move(names);
    screen_.set_robot(*robot_);
    jumps_ = true;
  }

  /// Saves the present run and starts another one.
  void restart() {
    save();
    dragged_.reset();
    std::unique_ptr<LiveRun> next = make_run();
    const std::unique_ptr<LiveRun> old = loop_.replace(std::move(next));
    show_run();
  }

  void save() {
    if (request_.record.empty()) return;
    std::optional<recordings::Recording> recording;
    scenarios::End end;
    loop_.use([&](const LiveRun& run) {
      recording = run.recording();
      end = run.scene().scenario.end;
    });
    if (recording->steps() == 0) return;
    const auto path = numbered(request_.record, ++saved_);
    recordings::write_recording(*recording, path);
    session_.recorded.push_back(
        fmt::format("{}: {}", path.string(), scenarios::ending_text(*recording, end)));
  }

  void change(const std::function<void(LiveSettings&)>& action) {
    action(settings_);
    loop_.use([&](LiveRun& run) {
      run.change(settings_);
      settings_ = run.settings();
    });
  }

  void drive(double velocity, double yaw_rate) {
    loop_.use([&](LiveRun& run) {
      run.drive(std::clamp(velocity, -largest_velocity, largest_velocity),
                std::clamp(yaw_rate, -largest_yaw_rate, largest_yaw_rate));
    });
  }

  void set_paused(bool paused) {
    paused_ = paused;
    loop_.set_paused(paused);
  }

  void bind_keys();
  void use_mouse(const Mouse& mouse);
  void draw(double seconds);
  std::vector<Chip> chips() const;
  std::vector<PanelLine> panel_lines() const;
  std::string sensors_name() const {
    return request_.sensors.empty() ? "ideal" : request_.sensors[sensors_].first;
  }

  LiveRequest request_;
  LiveSession session_;
  Window window_;
  Screen screen_;
  LiveSettings settings_;
  RealTimeLoop loop_;
  const models::RobotModel* robot_ = nullptr;
  std::vector<std::string> names_;    ///< of estimators
  std::vector<std::string> sources_;  ///< of contact for the policy
  std::optional<LivePlots> plots_;
  std::vector<KeyBinding> bindings_;
  LiveState state_;
  std::size_t sensors_ = 0;  ///< index of the profile
  double speed_ = 1.0;
  bool paused_ = false;
  bool shows_keys_ = false;
  bool jumps_ = true;  ///< the camera does not glide to the robot
  int saved_ = 0;
  Mouse last_mouse_;
  /// What the left button holds: the point that a drag pulls to, or nothing while it turns the
  /// camera.
  std::optional<Eigen::Vector3d> dragged_;
};

void LiveWindow::bind_keys() {
  const auto source = [this](std::size_t i) {
    change([&](LiveSettings& settings) { settings.contact_source = i; });
  };
  bindings_ = {
      {{'h'}, "h", "show or hide this list", [this](auto&) { shows_keys_ = !shows_keys_; }},
      {{key_up, key_down},
       "↑ ↓",
       "drive faster, slower or backwards",
       [this](const KeyPress& press) {
         drive(state_.velocity + (press.key == key_up ? velocity_step : -velocity_step),
               state_.yaw_rate);
         loop_.use([&](const LiveRun& run) { state_.velocity = run.velocity(); });
       }},
      {{key_left, key_right},
       "← →",
       "turn left, right",
       [this](const KeyPress& press) {
         drive(state_.velocity,
               state_.yaw_rate + (press.key == key_left ? yaw_rate_step : -yaw_rate_step));
         loop_.use([&](const LiveRun& run) { state_.yaw_rate = run.yaw_rate(); });
       }},
      {{key_backspace}, "Backspace", "stop driving", [this](auto&) { drive(0.0, 0.0); }},
      {{'c'},
       "c  C",
       "crouch lower, higher",
       [this](const KeyPress& press) {
         loop_.use([&](LiveRun& run) {
           run.crouch(stepped(run.hip(), press, crouch_step, 0.0, largest_crouch));
           state_.hip = run.hip();
         });
       }},
      {{'j'}, "j", "hop", [this](auto&) { loop_.use([](LiveRun& run) { run.hop(); }); }},
      {{' '}, "Space", "pause or continue", [this](auto&) { set_paused(!paused_); }},
      {{'.'},
       ".  :",
       "pause and simulate one step, 50 steps",
       [this](const KeyPress& press) {
         if (!paused_) set_paused(true);
         loop_.step(press.shift ? 50 : 1);
       }},
      {{'s', 'f'},
       "s  f",
       "half, double the speed",
       [this](const KeyPress& press) {
         speed_ = std::clamp(press.key == 's' ? speed_ / 2.0 : speed_ * 2.0, slowest, fastest);
         loop_.set_speed(speed_);
       }},
      {{'r'}, "r", "restart this run", [this](auto&) { restart(); }},
      {{'n'},
       "n",
       "start the next random draw",
       [this](auto&) {
         ++request_.scene.run;
         restart();
       }},
      {{'e'},
       "e",
       "change the physics engine, restart",
       [this](auto&) {
         request_.scene.engine = request_.scene.engine == "mujoco" ? "bullet" : "mujoco";
         restart();
       }},
      {{'o'},
       "o",
       "next contact source of the policy",
       [this, source](const KeyPress&) {
         source((settings_.contact_source + 1) % sources_.size());
       }},
      {{'b'},
       "b  B",
       "more, less delay of the policy's contact",
       [this](const KeyPress& press) {
         change([&](LiveSettings& settings) {
           settings.contact_delay =
               stepped(settings.contact_delay, press, delay_step, 0.0, largest_delay);
         });
       }},
      {{'t'},
       "t  T",
       "more, less torque noise",
       [this](const KeyPress& press) {
         change([&](LiveSettings& settings) {
           noise::SensorNoise& noise = settings.noise;
           noise.knee_torque = stepped(noise.knee_torque, press, torque_step, 0.0, largest_torque);
           noise.hip_torque = noise.wheel_torque = noise.knee_torque;
         });
       }},
      {{'a'},
       "a  A",
       "more, less accelerometer noise",
       [this](const KeyPress& press) {
         change([&](LiveSettings& settings) {
           settings.noise.acceleration = stepped(settings.noise.acceleration, press,
                                                 acceleration_step, 0.0, largest_acceleration);
         });
       }},
      {{'p'},
       "p",
       "next sensor profile",
       [this](auto&) {
         if (request_.sensors.empty()) return;
         sensors_ = (sensors_ + 1) % request_.sensors.size();
         change(
             [&](LiveSettings& settings) { settings.sensors = request_.sensors[sensors_].second; });
       }},
      {{'v'}, "v", "next camera", [this](auto&) { screen_.camera().next_mode(); }},
      {{'q', key_escape}, "q  Esc", "quit", [this](auto&) { window_.close(); }},
  };
}

void LiveWindow::use_mouse(const Mouse& mouse) {
  const Mouse before = std::exchange(last_mouse_, mouse);
  const bool in_scene = screen_.layout().scene.contains(mouse.x, mouse.y);
  if (in_scene) screen_.camera().approach(mouse.scrolled);
  const double right = mouse.x - before.x;
  const double down = mouse.y - before.y;
  const bool pressed = mouse.left && !before.left;
  if (pressed && in_scene && screen_.robot_under(mouse)) {
    const models::GroundTruth& truth = state_.truth;
    dragged_ = truth.base_position + truth.base_orientation * LiveRun::handle();
  }
  if (!mouse.left && dragged_) {
    dragged_.reset();
    loop_.use([](LiveRun& run) { run.drag(std::nullopt); });
  }
  if (dragged_) {
    *dragged_ += screen_.motion_of(*dragged_, right, down);
    loop_.use([&](LiveRun& run) { run.drag(Drag{*dragged_}); });
  } else if ((mouse.left && before.left) || (mouse.right && before.right)) {
    if (in_scene) screen_.camera().turn(right, down);
  }
}

std::vector<Chip> LiveWindow::chips() const {
  const double time = state_.period * static_cast<double>(state_.steps);
  std::vector<Chip> chips = {
      {request_.scene.engine == "mujoco" ? "MuJoCo" : "Bullet", dark},
      {fmt::format("t = {:.2f} s", time), grey},
      contact_chip((state_.contact[0] ? 1 : 0) + (state_.contact[1] ? 1 : 0))};
  if (state_.outcome) {
    chips.push_back({fmt::format("{}: r restarts", scenarios::outcome_text(*state_.outcome)), red});
  } else if (paused_) {
    chips.push_back({"PAUSED", dark});
  } else if (speed_ != 1.0) {
    chips.push_back({fmt::format("{:.3g}× speed", speed_), dark});
  }
  return chips;
}

std::vector<PanelLine> LiveWindow::panel_lines() const {
  std::vector<PanelLine> lines;
  const LiveScene& scene = request_.scene;
  lines.push_back({.text = "contact: left and right wheel", .value = "accuracy", .heading = true});
  lines.push_back({.text = "ground truth", .badges = ContactBadges{state_.contact}});
  for (std::size_t i = 0; i < names_.size(); ++i) {
    PanelLine line{.text = names_[i], .colour = render::rgb(estimator_colour(i))};
    if (i < state_.estimates.size()) {
      const LiveState::Estimate& estimate = state_.estimates[i];
      line.value = fmt::format("{:5.1f} %", 100.0 * estimate.accuracy);
      line.badges = ContactBadges{
          estimate.contact,
          {estimate.contact[0] != state_.contact[0], estimate.contact[1] != state_.contact[1]}};
    }
    lines.push_back(std::move(line));
  }
  lines.push_back({.text = "policy", .heading = true});
  lines.push_back({.text = "contact from (o)", .value = sources_[settings_.contact_source]});
  lines.push_back({.text = "  delayed by (b)",
                   .value = fmt::format("{:.0f} ms", 1e3 * settings_.contact_delay)});
  lines.push_back({.text = "  received", .badges = ContactBadges{state_.policy_contact}});
  lines.push_back({.text = "speed (↑ ↓)", .value = fmt::format("{:.1f} m/s", state_.velocity)});
  lines.push_back({.text = "turn (← →)", .value = fmt::format("{:.1f} rad/s", state_.yaw_rate)});
  lines.push_back({.text = "crouch (c)", .value = fmt::format("{:.1f} rad", state_.hip)});
  lines.push_back({.text = "sensors", .heading = true});
  lines.push_back({.text = "profile (p)", .value = sensors_name()});
  lines.push_back({.text = "torque noise (t)",
                   .value = fmt::format("{:.2f} N·m", settings_.noise.knee_torque)});
  lines.push_back({.text = "accelerometer noise (a)",
                   .value = fmt::format("{:.0f} m/s²", settings_.noise.acceleration)});
  lines.push_back({.text = scene.run < 0
                               ? "no random draw (n)"
                               : fmt::format("seed {}, draw {} (n)", scene.seed, scene.run),
                   .value = state_.rate > 0.0 ? fmt::format("{:.2f}× real time", state_.rate) : "",
                   .heading = true});
  lines.push_back({.text = "h: all keys", .heading = true});
  return lines;
}

void LiveWindow::draw(double seconds) {
  state_ = loop_.state();
  plots_->append(state_.samples);
  const models::GroundTruth& truth = state_.truth;
  std::array<double, models::servo_count> joints;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    joints[i] = state_.observation.servo[i].position;
  }
  if (truth.base_position.allFinite()) {
    models::write_pose(*robot_, truth.base_position, truth.base_orientation, joints,
                       screen_.data().qpos);
    mj_kinematics(robot_->mj.get(), &screen_.data());
    mj_comPos(robot_->mj.get(), &screen_.data());
    mj_camlight(robot_->mj.get(), &screen_.data());
  }
  screen_.camera().follow(truth.base_position, std::exchange(jumps_, false) ? 0.0 : seconds);
  std::vector<render::SceneVector> vectors;
  if (state_.drag_force.norm() > 1.0) {
    const Eigen::Vector3d from = truth.base_position + truth.base_orientation * LiveRun::handle();
    vectors.push_back({from, from + vector_length * state_.drag_force});
  }
  screen_.draw_scene(vectors);
  const Layout layout = screen_.layout();
  screen_.draw_chips(chips());
  if (shows_keys_) {
    screen_.draw_centred(key_list(screen_.pen(), bindings_,
                                  {{"drag the robot", "push, pull or lift it"},
                                   {"drag elsewhere", "turn the camera"},
                                   {"mouse wheel", "move the camera"}},
                                  layout.scene.width, layout.scene.height));
  }
  screen_.draw(panel(screen_.pen(), panel_lines(), layout.panel.width, layout.panel.height),
               layout.panel.left, layout.panel.top);
  screen_.draw(plots_->draw(layout.plots.width, layout.plots.height), layout.plots.left,
               layout.plots.top);
  window_.show();
}

}  // namespace

LiveSession watch_live(LiveRequest request, const std::atomic<bool>& stop) {
  return LiveWindow(std::move(request)).watch(stop);
}

}  // namespace touchdown::viewer
