#pragma once

#include <atomic>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

#include "apps/viewer/curves.hpp"
#include "apps/viewer/label_editor.hpp"
#include "apps/viewer/screen.hpp"
#include "apps/viewer/watch.hpp"
#include "render/film/scene_view.hpp"

namespace touchdown::viewer {

/// Heights that labels add to the plots (px): both wheels' labels of the whole log; ruler and
/// lanes.
inline constexpr float overview_height = 22.0F, lanes_height = 70.0F;

/// A person's film of a log, picture by picture.
class Film {
 public:
  /// Errors: `InputError` for a file that is no film.
  explicit Film(const std::filesystem::path& path);

  double frame_period() const { return 1.0 / rate_; }  ///< s
  cv::Size size() const { return size_; }

  /// The picture that is shown at a time of the film (s), valid until the next call; an empty one
  /// before its start and after its end. Pictures that follow the last one soon are decoded on the
  /// way, others are sought.
  const cv::Mat& at(double time);

 private:
  const cv::Mat& frame(long number);

  cv::VideoCapture capture_;
  double rate_ = 0.0;  ///< pictures per second
  cv::Size size_;
  long count_ = 0;
  long decoded_ = -1;  ///< the number of `picture_`
  cv::Mat picture_, none_;
};

/// The window that plays a log: scene, panel, time line and curves; with labels the lanes in which
/// they are edited, with a film its pictures. Its keys are in log_keys.cpp, its pictures in
/// log_pictures.cpp.
class LogWindow {
 public:
  /// Keeps a reference to `run`. Errors: those of `Film` and `Screen`.
  LogWindow(LoggedRun& run, const LogSession& session);

  void watch(const std::atomic<bool>& stop) {
    screen_.watch(stop, [this](double seconds) { draw(seconds); });
  }

  /// What to print at the end. Errors: those of `LabelEditor::finish`.
  std::string finish();

 private:
  double period() const { return run_.recording.period(); }
  double duration() const { return period() * static_cast<double>(poses_.count() - 1); }
  void seek(double time) { time_ = std::clamp(time, 0.0, duration()); }
  std::size_t row() const {
    return std::min(static_cast<std::size_t>(std::llround(time_ / period())), poses_.count() - 1);
  }
  /// The present by the log's clock, which may jitter or have gaps.
  double now() const { return clock_.time_of(row()); }
  void seek_clock(std::optional<double> time) {
    if (!time) return;
    seek(static_cast<double>(clock_.step_at(*time)) * period());
    paused_ = true;
    jumps_ = true;
  }

  /// Jumps to the next event, or to the one before, and pauses there.
  void jump(const std::vector<StepRange>& events, bool back);
  /// Finds flights and errors anew, of another estimator or after an edit.
  void find_events();
  std::vector<std::uint8_t> known_wheels() const;
  void bind_time_keys();
  void bind_label_keys();
  void bind_film_keys();
  void edit(const std::function<void(LabelEditor&)>& action);
  void set_state(logs::LabelState state, bool both_wheels);
  void draw(double seconds);
  void draw_scene(double seconds);
  void draw_film();
  void draw_panel() const;
  void add_contact_lines() const;
  void add_label_lines() const;
  void draw_plots();
  void draw_time_line();
  void draw_lanes(const LaneScale& scale);
  /// Selects and drags what the mouse holds in a wheel's lane, the last widget.
  void use_lane(std::size_t wheel, const LaneScale& scale);

  /// Position of the present among the plots: a share of their width.
  double present() const { return editor_ ? 0.5 : 0.75; }

  LoggedRun& run_;
  std::optional<Film> film_;
  double film_offset_;  ///< of the film's time before the log's (s)
  Screen screen_;
  render::Poses poses_;
  LogClock clock_;
  std::optional<LabelEditor> editor_;
  std::size_t estimator_ = 0;  ///< the one with the errors
  std::vector<StepRange> flights_, errors_;
  std::vector<render::StripRow> rows_;  ///< plots
  double view_seconds_ = 4.0;           ///< that they show
  double time_ = 0.0;
  double speed_ = 1.0;
  bool paused_ = false;
  bool jumps_ = true;
};

}  // namespace touchdown::viewer
