#include "viewer/watch_live.hpp"

#include <chrono>
#include <cmath>
#include <optional>
#include <thread>
#include <utility>

#include "render/film/scene_view.hpp"
#include "viewer/live_keys.hpp"
#include "viewer/live_panel.hpp"
#include "viewer/screen/live_plots.hpp"
#include "viewer/screen/screen.hpp"

namespace touchdown::viewer {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double vector_length = 0.01;  // m per N

/// A window in which a user watches and drives a live run.
class LiveWindow {
 public:
  explicit LiveWindow(LiveRequest request)
      : measures_(request.measures),
        window_("touchdown: " + request.scene.scenario.name, request.width, request.height),
        screen_(window_),
        controls_(std::move(request), [this] { show_run(); }),
        bindings_(live_keys(controls_, {.toggle_list = [this] { shows_keys_ = !shows_keys_; },
                                        .next_camera = [this] { screen_.camera().next_mode(); },
                                        .quit = [this] { window_.close(); }})) {
    show_run();
  }

  LiveSession watch(const std::atomic<bool>& stop) {
    LiveSession session;
    const Clock::time_point start = Clock::now();
    Clock::time_point last = start;
    while (window_.is_open() && !stop) {
      const Clock::time_point now = Clock::now();
      draw(std::chrono::duration<double>(now - last).count());
      last = now;
      ++session.frames;
      const WindowInput input = window_.take_input();
      act_on(bindings_, input.keys);
      use_mouse(input.mouse);
      std::this_thread::sleep_until(now + shortest_frame);
    }
    session.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    controls_.save();
    session.recorded = controls_.saved();
    if (measures_) session.times = times_;
    return session;
  }

 private:
  void show_run();
  void use_mouse(const Mouse& mouse);
  void draw(double seconds);
  void draw_scene(double seconds);
  Eigen::Vector3d handle() const {
    const models::GroundTruth& truth = state_.truth;
    return truth.base_position + truth.base_orientation * LiveRun::handle();
  }

  /// Adds the seconds since `start`, until all drawing is done, and begins the next part.
  void measure(double& seconds, Clock::time_point& start) const {
    if (!measures_) return;
    mjr_finish();
    const Clock::time_point now = Clock::now();
    seconds += std::chrono::duration<double>(now - start).count();
    start = now;
  }

  bool measures_;
  PictureTimes times_;
  Window window_;
  Screen screen_;
  LiveControls controls_;
  std::vector<KeyBinding> bindings_;
  std::optional<LivePlots> plots_;
  LiveState state_;
  std::vector<PanelLine> lines_;  ///< of the panel
  bool shows_keys_ = false;
  bool jumps_ = true;  ///< the camera does not glide to the robot
  Mouse last_mouse_;
  /// What the left button holds: the point that a drag pulls to, a slider, or nothing while it
  /// turns the camera.
  std::optional<Eigen::Vector3d> dragged_;
  std::optional<LiveNumber> slid_;
};

/// Makes screen and curves anew for another run.
void LiveWindow::show_run() {
  constexpr double gravity = 9.81;
  const simulators::Simulator& simulator = controls_.simulator();
  const models::RobotModel& robot = simulator.model();
  plots_.emplace(controls_.estimators().size(), LiveRun::sample_steps * simulator.control_period(),
                 gravity * robot.mj->body_subtreemass[0]);
  screen_.set_robot(robot);
  dragged_.reset();
  jumps_ = true;
}

void LiveWindow::use_mouse(const Mouse& mouse) {
  const Mouse before = std::exchange(last_mouse_, mouse);
  const Layout layout = screen_.layout();
  const bool in_scene = layout.scene.contains(mouse.x, mouse.y);
  if (in_scene) screen_.camera().approach(mouse.scrolled);
  const double right = mouse.x - before.x;
  const double down = mouse.y - before.y;
  if (mouse.left && !before.left) {
    if (in_scene && screen_.robot_under(mouse)) dragged_ = handle();
    const auto slider = slider_at(lines_, layout.panel.width, layout.panel.height,
                                  mouse.x - layout.panel.left, mouse.y - layout.panel.top);
    if (layout.panel.contains(mouse.x, mouse.y) && slider) {
      slid_ = static_cast<LiveNumber>(slider->number);
    }
  }
  if (!mouse.left) {
    slid_.reset();
    if (dragged_) controls_.drag(std::nullopt);
    dragged_.reset();
  }
  if (slid_) {
    const LiveRange range = range_of(*slid_);
    const double share = slider_share(layout.panel.width, mouse.x - layout.panel.left);
    controls_.set(*slid_, range.step * std::round(share * range.most / range.step));
  } else if (dragged_) {
    *dragged_ += screen_.motion_of(*dragged_, right, down);
    controls_.drag(Drag{*dragged_});
  } else if ((mouse.left && before.left) || (mouse.right && before.right)) {
    if (in_scene) screen_.camera().turn(right, down);
  }
}

void LiveWindow::draw_scene(double seconds) {
  const models::GroundTruth& truth = state_.truth;
  const models::RobotModel& robot = controls_.simulator().model();
  std::array<double, models::servo_count> joints;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    joints[i] = state_.observation.servo[i].position;
  }
  if (truth.base_position.allFinite()) {
    models::write_pose(robot, truth.base_position, truth.base_orientation, joints,
                       screen_.data().qpos);
    render::update_geoms(*robot.mj, screen_.data());
  }
  screen_.camera().follow(truth.base_position, std::exchange(jumps_, false) ? 0.0 : seconds);
  std::vector<render::SceneVector> vectors;
  if (state_.drag_force.norm() > 1.0) {
    vectors.push_back({handle(), handle() + vector_length * state_.drag_force});
  }
  screen_.draw_scene(vectors);
}

void LiveWindow::draw(double seconds) {
  Clock::time_point start = Clock::now();
  state_ = controls_.state();
  draw_scene(seconds);
  measure(times_.scene, start);
  plots_->append(state_.samples);
  const Layout layout = screen_.layout();
  screen_.draw_chips(live_chips(controls_, state_));
  if (shows_keys_) {
    screen_.draw_at_edge(key_list(screen_.pen(), bindings_,
                                  {{"drag the robot", "push, pull or lift it"},
                                   {"drag elsewhere", "turn the camera"},
                                   {"mouse wheel", "move the camera"},
                                   {"drag a blue bar", "set noise or delay"},
                                   {"errors are red", "more of them: t, a, p, e, lift it"}},
                                  layout.scene.width, layout.scene.height));
  }
  lines_ = live_panel(controls_, state_);
  screen_.draw(panel(screen_.pen(), lines_, layout.panel.width, layout.panel.height),
               layout.panel.left, layout.panel.top);
  screen_.draw(plots_->draw(layout.plots.width, layout.plots.height), layout.plots.left,
               layout.plots.top);
  measure(times_.overlay, start);
  window_.show();
  measure(times_.display, start);
}

}  // namespace

LiveSession watch_live(LiveRequest request, const std::atomic<bool>& stop) {
  return LiveWindow(std::move(request)).watch(stop);
}

}  // namespace touchdown::viewer
