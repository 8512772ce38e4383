#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

namespace touchdown::render {

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
