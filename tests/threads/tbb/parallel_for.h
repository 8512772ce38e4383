#pragma once
// ThreadSanitizer cannot see the synchronisation inside Debian's libtbb and reports false races. The
// `tsan` preset uses these headers instead of TBB's. They implement the calls of this project on
// threads that it can see. They do not balance load, and nested loops start more threads.

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include <tbb/global_control.h>

namespace tbb {

template <typename Index, typename Function>
void parallel_for(Index first, Index last, const Function& function) {
  std::atomic<Index> next = first;
  std::atomic<bool> failed = false;
  std::exception_ptr error;
  std::mutex of_error;
  const auto work = [&] {
    for (Index i = next++; i < last && !failed; i = next++) {
      try {
        function(i);
      } catch (...) {
        const std::lock_guard lock(of_error);
        if (!failed.exchange(true)) error = std::current_exception();
      }
    }
  };
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 1; i < global_control::threads(); ++i) threads.emplace_back(work);
    work();
  }
  if (error) std::rethrow_exception(error);
}

template <typename Index>
class blocked_range {
 public:
  blocked_range(Index begin, Index end, std::size_t = 1) : begin_(begin), end_(end) {}
  Index begin() const { return begin_; }
  Index end() const { return end_; }

 private:
  Index begin_;
  Index end_;
};

template <typename Index, typename Function>
void parallel_for(const blocked_range<Index>& range, const Function& function) {
  parallel_for(range.begin(), range.end(),
               [&](Index i) { function(blocked_range<Index>(i, i + 1)); });
}

}  // namespace tbb
