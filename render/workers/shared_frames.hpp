#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <new>
#include <semaphore.h>
#include <sys/mman.h>

#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown::render {

/// Frames that a worker may be ahead of the consumer.
inline constexpr std::size_t frame_slots = 4;

/// One worker's side of the shared memory; the frames follow all of these.
struct Lane {
  sem_t free;   ///< slots that may be painted into
  sem_t ready;  ///< slots that may be consumed
  std::atomic<bool> failed;
  std::array<char, 512> message;
};

/// Memory that this process and the ones forked from it share; it has no name, so that nothing is
/// left of it when they are gone.
class SharedLanes {
 public:
  SharedLanes(std::size_t count, std::size_t frame_bytes)
      : count_(count), frame_bytes_((frame_bytes + 63) / 64 * 64) {
    size_ = header() + count * frame_slots * frame_bytes_;
    void* const memory =
        ::mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) {
      throw Error(fmt::format("no memory for {} MB of frames", size_ / 1'000'000));
    }
    memory_ = static_cast<std::uint8_t*>(memory);
    for (std::size_t i = 0; i < count; ++i) {
      Lane* const fresh = new (memory_ + i * sizeof(Lane)) Lane{};
      ::sem_init(&fresh->free, 1, frame_slots);
      ::sem_init(&fresh->ready, 1, 0);
    }
  }
  ~SharedLanes() { ::munmap(memory_, size_); }
  SharedLanes(const SharedLanes&) = delete;
  SharedLanes& operator=(const SharedLanes&) = delete;

  Lane& lane(std::size_t worker) {
    return *std::launder(reinterpret_cast<Lane*>(memory_ + worker * sizeof(Lane)));
  }
  std::uint8_t* slot(std::size_t worker, std::size_t number) {
    return memory_ + header() + (worker * frame_slots + number % frame_slots) * frame_bytes_;
  }

 private:
  std::size_t header() const { return (count_ * sizeof(Lane) + 63) / 64 * 64; }

  std::size_t count_;
  std::size_t frame_bytes_;
  std::size_t size_ = 0;
  std::uint8_t* memory_ = nullptr;
};

}  // namespace touchdown::render
