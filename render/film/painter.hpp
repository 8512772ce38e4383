#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include <opencv2/core.hpp>

#include "render/film/gl_context.hpp"
#include "render/film/request.hpp"
#include "render/film/scene_view.hpp"
#include "render/film/strip.hpp"

namespace touchdown::render {

/// The row of a recording at `time` (s).
std::size_t row_at(const logs::Recording& recording, double time);

/// The size of the only view in the pictures of a film with labels and strip (px).
cv::Size single_view_size(const VideoOptions& options);

/// Composes the pictures of one film: up to `most_sources` views in a grid and, if `annotated`,
/// labels on them and the strip below.
class FrameComposer {
 public:
  /// Keeps the sources' references.
  FrameComposer(const std::vector<VideoSource>& sources, const VideoOptions& options,
                bool annotated);

  /// The size of each run's view in the picture (px).
  cv::Size view_size() const;

  /// Puts a view (8UC4, BGRA) in the place of run `i`. A larger view is reduced; of a wider one,
  /// the middle is shown.
  void place(std::size_t i, const cv::Mat& view);

  /// The picture (8UC3, BGR) with the placed views, labels and strip at `time` of the recordings
  /// (s). Valid until the next call.
  const cv::Mat& picture(double time);

 private:
  struct Run {
    VideoSource source;
    std::vector<std::uint8_t> contact;  ///< without states that are too short to be read
  };
  cv::Rect pane(std::size_t i) const;
  void write_labels(std::size_t i, double time);

  VideoOptions options_;
  int strip_height_;  ///< 0 without one
  std::vector<Run> runs_;
  std::unique_ptr<SignalStrip> strip_;
  TextPen pen_;
  cv::Mat reduced_;
  cv::Mat picture_;
};

/// Paints the pictures of one or several films at a point in time. The view of each run is painted
/// once for all films. A picture depends on the time alone, not on previous ones.
class FramePainter {
 public:
  /// Creates the process's OpenGL context. Keeps the sources' references.
  FramePainter(const std::vector<VideoSource>& sources, const std::vector<Film>& films,
               bool annotated = true);
  /// One film of all sources.
  FramePainter(const std::vector<VideoSource>& sources, const VideoOptions& options,
               bool annotated = true);
  ~FramePainter();

  /// The picture (8UC3, BGR) of the first film at `time` of the recordings (s). Valid until the
  /// next call.
  cv::Mat paint(double time);

  /// Likewise of each film; an empty one for films that are not `wanted`.
  std::vector<cv::Mat> paint(double time, const std::vector<bool>& wanted);

 private:
  struct Show;
  /// The view of a run (8UC4, BGRA), valid until the next call.
  cv::Mat view(std::size_t run, double time);

  std::vector<Film> films_;
  std::vector<FrameComposer> composers_;
  GlContext gl_;  ///< as large as one view
  std::vector<std::unique_ptr<Show>> shows_;
};

/// Fills `pixels` with frame `frame`.
using PaintFrame = std::function<void(int frame, std::uint8_t* pixels)>;

/// Paints frames 0..frames−1 of `frame_bytes` each in forked processes and passes them to
/// `consume`, in this process and in order.
///
/// Each worker calls `prepare` once, and then the returned painter for every `workers`-th frame. No
/// pixel may depend on the worker or on the frames that it painted before. `workers` 0 means one
/// per core. If the system creates fewer processes, fewer work; if it creates none, this process
/// paints. Workers exit with this process, or when this function returns or throws. No named object
/// is created.
///
/// `begin`, if given, is called in this process after the workers are forked and before anything is
/// painted. Threads that `consume` needs must be started there: a fork copies locks that another
/// thread holds, but not the thread that would release them.
///
/// This process must not have an OpenGL context. Errors: `Error` with the worker's message when
/// painting throws, or when a worker dies; all exceptions of `begin` and `consume`.
void paint_in_order(int frames, std::size_t frame_bytes, int workers,
                    const std::function<PaintFrame()>& prepare,
                    const std::function<void(int frame, const std::uint8_t* pixels)>& consume,
                    const std::function<void()>& begin = {});

}  // namespace touchdown::render
