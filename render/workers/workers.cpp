#include "render/workers/workers.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <semaphore.h>
#include <string>
#include <thread>
#include <unistd.h>

#include <opencv2/core.hpp>

#include "core/error.hpp"
#include "render/workers/processes.hpp"
#include "render/workers/shared_frames.hpp"

namespace touchdown::render {
namespace {

/// A worker's life: never returns.
[[noreturn]] void work(std::size_t worker, std::size_t workers, int frames, SharedLanes& lanes,
                       const std::function<PaintFrame()>& prepare) {
  Lane& lane = lanes.lane(worker);
  try {
    // One rasteriser thread per process, and no thread pool: the parent's did not survive the fork.
    ::setenv("LP_NUM_THREADS", "0", 1);
    cv::setNumThreads(1);
    const PaintFrame paint = prepare();
    std::size_t number = 0;
    for (std::size_t frame = worker; frame < static_cast<std::size_t>(frames); frame += workers) {
      while (::sem_wait(&lane.free) != 0 && errno == EINTR) {
      }
      paint(static_cast<int>(frame), lanes.slot(worker, number++));
      ::sem_post(&lane.ready);
    }
  } catch (const std::exception& error) {
    std::strncpy(lane.message.data(), error.what(), lane.message.size() - 1);
    lane.failed = true;
    ::sem_post(&lane.ready);
    ::_exit(1);
  }
  ::_exit(0);
}

void wait_for_frame(Lane& lane, Workers& workers, std::size_t worker) {
  while (true) {
    timespec until = {};
    ::clock_gettime(CLOCK_REALTIME, &until);
    until.tv_nsec += 100'000'000;
    until.tv_sec += until.tv_nsec / 1'000'000'000;
    until.tv_nsec %= 1'000'000'000;
    if (::sem_timedwait(&lane.ready, &until) == 0) break;
    // Gone, but perhaps only after its last frame: look once more.
    if (errno == ETIMEDOUT && workers.gone(worker) && ::sem_trywait(&lane.ready) != 0) {
      throw Error("a process that paints frames was killed");
    }
  }
  if (lane.failed) throw Error(lane.message.data());
}

}  // namespace

void paint_in_order(int frames, std::size_t frame_bytes, int workers,
                    const std::function<PaintFrame()>& prepare,
                    const std::function<void(int, const std::uint8_t*)>& consume) {
  if (frames <= 0) return;
  if (workers <= 0) workers = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const auto wanted = static_cast<std::size_t>(std::min(workers, frames));
  SharedLanes lanes(wanted, frame_bytes);

  // A worker must know how many there are before it starts: find out what the system gives, with
  // processes that wait for the number.
  Workers processes;
  SharedLanes gate(1, sizeof(std::size_t));
  for (std::size_t i = 0; i < wanted; ++i) {
    const bool started = processes.start([&, i] {
      while (::sem_wait(&gate.lane(0).ready) != 0 && errno == EINTR) {
      }
      std::size_t count = 0;
      std::memcpy(&count, gate.slot(0, 0), sizeof(count));
      work(i, count, frames, lanes, prepare);
    });
    if (!started) break;
  }
  const std::size_t count = processes.count();
  if (count == 0) {
    const PaintFrame paint = prepare();
    for (int frame = 0; frame < frames; ++frame) {
      paint(frame, lanes.slot(0, 0));
      consume(frame, lanes.slot(0, 0));
    }
    return;
  }
  std::memcpy(gate.slot(0, 0), &count, sizeof(count));
  for (std::size_t i = 0; i < count; ++i) ::sem_post(&gate.lane(0).ready);

  for (int frame = 0; frame < frames; ++frame) {
    const std::size_t worker = static_cast<std::size_t>(frame) % count;
    Lane& lane = lanes.lane(worker);
    wait_for_frame(lane, processes, worker);
    consume(frame, lanes.slot(worker, static_cast<std::size_t>(frame) / count));
    ::sem_post(&lane.free);
  }
}

}  // namespace touchdown::render
