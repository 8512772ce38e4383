#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

namespace touchdown::render {

/// Fills `pixels` with frame `frame`.
using PaintFrame = std::function<void(int frame, std::uint8_t* pixels)>;

/// Paint frames 0..frames−1 of `frame_bytes` each in forked processes and hand them to `consume`,
/// in this process and in order.
///
/// Each worker calls `prepare` once and then the painter it returned, for every `workers`-th frame,
/// so no pixel may depend on which worker painted it or what it painted before. `workers` 0 means
/// one per core; if the system gives fewer processes, fewer work, and if it gives none this one
/// paints. Workers die with this process or when this function returns or throws; nothing with a
/// name is created.
///
/// `begin`, if there is one, is called in this process before anything is painted and after the
/// workers are forked: what `consume` needs threads for starts them there, for a fork among threads
/// inherits the locks that they hold just then, and nobody to release them.
///
/// This process must not have an OpenGL context. Errors: `Error` with the worker's own message when
/// painting throws, or when a worker dies; whatever `begin` and `consume` throw.
void paint_in_order(int frames, std::size_t frame_bytes, int workers,
                    const std::function<PaintFrame()>& prepare,
                    const std::function<void(int frame, const std::uint8_t* pixels)>& consume,
                    const std::function<void()>& begin = {});

}  // namespace touchdown::render
