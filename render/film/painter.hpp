#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "render/film/gl_context.hpp"
#include "render/film/request.hpp"
#include "render/film/scene_view.hpp"
#include "render/film/strip.hpp"

namespace touchdown::render {

/// The row of a recording at `time` (s).
std::size_t row_at(const logs::Recording& recording, double time);

/// Paints the pictures of a film: up to `most_sources` views in a grid and, if `annotated`, labels
/// on them and the strip below. A picture depends on its time alone, not on previous ones.
class FramePainter {
 public:
  /// Creates the process's OpenGL context. Keeps the sources' references.
  FramePainter(const std::vector<VideoSource>& sources, const VideoOptions& options,
               bool annotated = true);
  ~FramePainter();

  /// The picture (8UC3, BGR) at `time` of the recordings (s). Valid until the next call.
  const cv::Mat& paint(double time);

 private:
  struct Show;
  cv::Size view_size() const;  ///< of each run in the picture (px)
  cv::Rect pane(std::size_t i) const;
  void paint_view(std::size_t i, double time);
  void write_labels(std::size_t i, double time);

  VideoOptions options_;
  int strip_height_;             ///< 0 without one
  std::optional<GlContext> gl_;  ///< as large as a view is painted
  std::vector<std::unique_ptr<Show>> shows_;
  std::unique_ptr<SignalStrip> strip_;
  TextPen pen_;
  cv::Mat reduced_, picture_;
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
