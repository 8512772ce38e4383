#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <new>
#include <semaphore.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include "core/error.hpp"
#include "core/machine.hpp"
#include "render/film/painter.hpp"

namespace touchdown::render {
namespace {

/// Forked processes. The destructor kills those that still run and waits for all.
class Workers {
 public:
  Workers() = default;
  ~Workers() {
    for (const pid_t pid : pids_) {
      if (pid > 0) ::kill(pid, SIGKILL);
    }
    for (const pid_t pid : pids_) {
      if (pid > 0) ::waitpid(pid, nullptr, 0);
    }
  }
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// False when the system cannot create another process.
  template <typename Work>
  bool start(const Work& work_in_child) {
    const pid_t parent = ::getpid();
    const pid_t pid = ::fork();
    if (pid < 0) return false;
    if (pid == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (::getppid() != parent) ::_exit(1);
      work_in_child();
    }
    pids_.push_back(pid);
    return true;
  }

  bool has_exited(std::size_t worker) {
    if (pids_[worker] < 0) return true;
    if (::waitpid(pids_[worker], nullptr, WNOHANG) == 0) return false;
    pids_[worker] = -1;
    return true;
  }

  std::size_t count() const { return pids_.size(); }

 private:
  std::vector<pid_t> pids_;
};

/// The number of frames by which a worker may be ahead of the consumer.
constexpr std::size_t frame_slots = 4;

/// One worker's channel in the shared memory. The frames follow all channels.
struct Channel {
  std::size_t workers;  ///< the number of workers; set before the first free slot
  sem_t free;           ///< slots that may be painted into
  sem_t ready;          ///< slots that may be consumed
  std::atomic<bool> failed;
  std::array<char, 512> message;
};

/// Memory shared by this process and the ones forked from it. It has no name, so that the system
/// frees it when the processes exit.
class SharedFrames {
 public:
  SharedFrames(std::size_t count, std::size_t frame_bytes)
      : count_(count), frame_bytes_((frame_bytes + 63) / 64 * 64) {
    size_ = header() + count * frame_slots * frame_bytes_;
    void* const memory =
        ::mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) {
      throw Error(fmt::format("no memory for {} MB of frames", size_ / 1'000'000));
    }
    memory_ = static_cast<std::uint8_t*>(memory);
    for (std::size_t i = 0; i < count; ++i) {
      Channel* const channel = new (memory_ + i * sizeof(Channel)) Channel{};
      ::sem_init(&channel->free, 1, 0);
      ::sem_init(&channel->ready, 1, 0);
    }
  }
  ~SharedFrames() { ::munmap(memory_, size_); }
  SharedFrames(const SharedFrames&) = delete;
  SharedFrames& operator=(const SharedFrames&) = delete;

  Channel& channel(std::size_t worker) {
    return *std::launder(reinterpret_cast<Channel*>(memory_ + worker * sizeof(Channel)));
  }
  std::uint8_t* slot(std::size_t worker, std::size_t number) {
    return memory_ + header() + (worker * frame_slots + number % frame_slots) * frame_bytes_;
  }

 private:
  std::size_t header() const { return (count_ * sizeof(Channel) + 63) / 64 * 64; }

  std::size_t count_;
  std::size_t frame_bytes_;
  std::size_t size_ = 0;
  std::uint8_t* memory_ = nullptr;
};

[[noreturn]] void work(std::size_t worker, int frames, SharedFrames& shared,
                       const std::function<PaintFrame()>& prepare) {
  Channel& channel = shared.channel(worker);
  try {
    cv::setNumThreads(1);  // a fork does not copy the parent's threads
    const PaintFrame paint = prepare();
    std::size_t number = 0;
    for (std::size_t frame = worker; frame < static_cast<std::size_t>(frames);
         frame += channel.workers) {
      while (::sem_wait(&channel.free) != 0 && errno == EINTR) {
      }
      paint(static_cast<int>(frame), shared.slot(worker, number++));
      ::sem_post(&channel.ready);
    }
  } catch (const std::exception& error) {
    std::strncpy(channel.message.data(), error.what(), channel.message.size() - 1);
    channel.failed = true;
    ::sem_post(&channel.ready);
    ::_exit(1);
  }
  ::_exit(0);
}

void wait_for_frame(Channel& channel, Workers& workers, std::size_t worker) {
  while (true) {
    timespec until = {};
    ::clock_gettime(CLOCK_REALTIME, &until);
    until.tv_nsec += 100'000'000;
    until.tv_sec += until.tv_nsec / 1'000'000'000;
    until.tv_nsec %= 1'000'000'000;
    if (::sem_timedwait(&channel.ready, &until) == 0) break;
    // The worker may have exited after its last frame: check once more.
    if (errno == ETIMEDOUT && workers.has_exited(worker) && ::sem_trywait(&channel.ready) != 0) {
      throw Error("a process that paints frames was killed");
    }
  }
  if (channel.failed) throw Error(channel.message.data());
}

}  // namespace

void paint_in_order(int frames, std::size_t frame_bytes, int workers,
                    const std::function<PaintFrame()>& prepare,
                    const std::function<void(int, const std::uint8_t*)>& consume,
                    const std::function<void()>& begin) {
  if (frames <= 0) return;
  if (workers <= 0) workers = machine_share().processors;
  const auto wanted = static_cast<std::size_t>(std::min(workers, frames));
  SharedFrames shared(wanted, frame_bytes);

  Workers processes;
  for (std::size_t i = 0; i < wanted; ++i) {
    if (!processes.start([&, i] { work(i, frames, shared, prepare); })) break;
  }
  const std::size_t count = processes.count();
  if (begin) begin();
  if (count == 0) {
    const PaintFrame paint = prepare();
    for (int frame = 0; frame < frames; ++frame) {
      paint(frame, shared.slot(0, 0));
      consume(frame, shared.slot(0, 0));
    }
    return;
  }
  // Workers must know their number before they paint. It is certain only after the last fork.
  for (std::size_t i = 0; i < count; ++i) {
    shared.channel(i).workers = count;
    for (std::size_t slot = 0; slot < frame_slots; ++slot) ::sem_post(&shared.channel(i).free);
  }
  for (int frame = 0; frame < frames; ++frame) {
    const std::size_t worker = static_cast<std::size_t>(frame) % count;
    Channel& channel = shared.channel(worker);
    wait_for_frame(channel, processes, worker);
    consume(frame, shared.slot(worker, static_cast<std::size_t>(frame) / count));
    ::sem_post(&channel.free);
  }
}

}  // namespace touchdown::render
