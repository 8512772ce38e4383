#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/viewer/live_controls.hpp"
#include "logs/log/label_edits.hpp"
#include "logs/recording.hpp"
#include "models/robot_model.hpp"
#include "render/film/request.hpp"
#include "render/palette.hpp"

namespace touchdown::viewer {

/// The colour (0xRRGGBB) of the i-th estimator, as in figures and films.
inline unsigned estimator_colour(std::size_t i) { return render::line_colour(i + 1); }

/// The times of a session's pictures (s, all of them added).
struct PictureTimes {
  double scene = 0.0;    ///< MuJoCo draws robot and terrain
  double overlay = 0.0;  ///< labels, panel and plots
  double display = 0.0;  ///< the window system shows the picture
};

struct LiveSession {
  std::vector<std::string> recorded;  ///< one line per recording
  int frames = 0;
  double seconds = 0.0;               ///< of the session
  std::optional<PictureTimes> times;  ///< if the request measures them
};

/// Shows a robot in a window and lets the user drive it, until the window is closed or `stop` is
/// true. Errors: `Error` without a display.
LiveSession watch_live(LiveRequest request, const std::atomic<bool>& stop);

/// A recording or log with everything that is shown of it.
struct LoggedRun {
  std::string name;
  models::RobotModel robot;
  logs::Recording recording;
  std::vector<render::BeliefTrack> beliefs;
  /// True contact by row, from ground truth or labels; empty without them. Time without labels is
  /// unknown.
  std::array<std::vector<logs::LabelState>, models::wheel_count> contact;
};

/// The contact that labels give each row of the recording.
std::array<std::vector<logs::LabelState>, models::wheel_count> labelled_contact(
    const logs::Recording& recording, const logs::ContactIntervals& labels);

/// The contact of the recording's ground truth, which it must have.
std::array<std::vector<logs::LabelState>, models::wheel_count> true_contact(
    const logs::Recording& recording, const scoring::LabelConfig& definition);

bool is_known(const LoggedRun& run, std::size_t row);

/// A segment of a run: steps [begin, end).
struct StepRange {
  std::size_t begin, end;

  bool operator==(const StepRange&) const = default;
};

/// The steps at which `values` is true, as maximal ranges.
std::vector<StepRange> ranges_of(const std::vector<std::uint8_t>& values);

/// The flights of each wheel, in order, as the score counts them: it is known to be in the air for
/// at least `ScoringConfig::minimum_flight`. If the contact of no row is known, by the first
/// estimator's beliefs.
std::vector<StepRange> flights_of(const LoggedRun& run);

/// Where the decision of estimator `index` differs from the known contact of a wheel for at least
/// 5 ms.
std::vector<StepRange> errors_of(const LoggedRun& run, std::size_t index);

struct LogSession {
  /// To be edited; their file is written after each edit.
  std::optional<logs::ContactIntervals> labels = {};
  std::filesystem::path film = {};  ///< of a person; empty: none
  double film_offset = 0.0;         ///< the film's time when the log's is zero (s)
  int width = 1280, height = 720;   ///< of the window
};

/// Plays the run in a window until the window is closed or `stop` is true. Returns the lines to
/// print: what was changed and saved, and the film's offset. Errors: `Error` without a display, or
/// if labels cannot be saved; `InputError` for a file that is no film.
std::string watch_log(LoggedRun run, const LogSession& session, const std::atomic<bool>& stop);

}  // namespace touchdown::viewer
