#pragma once

#include <cstdint>
#include <memory>
#include <vector>

namespace touchdown::render {

/// An OpenGL context that draws into plain memory, without a display or a GPU, and is current in
/// the thread that made it for as long as it lives.
///
/// All contexts of one process share one rasteriser: for more speed use more processes
/// (`paint_in_order`). Never fork a process that has one. Errors: `Error` when Mesa cannot make it.
class GlContext {
 public:
  GlContext(int width, int height);
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// Waits until all drawing is in `pixels`.
  void finish();

  /// BGRA, 8 bits each, rows from the top, no padding.
  std::uint8_t* pixels() { return pixels_.data(); }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  int width_;
  int height_;
  std::vector<std::uint8_t> pixels_;
  void* context_ = nullptr;
};

}  // namespace touchdown::render
