#include <csignal>
#include <filesystem>
#include <numeric>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "render/film/painter.hpp"

namespace touchdown::render {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

PaintFrame number_painter() {
  return [](int frame, std::uint8_t* pixels) {
    for (int i = 0; i < 100; ++i) pixels[i] = static_cast<std::uint8_t>(frame * 7 + i);
  };
}

bool has_children() { return ::waitpid(-1, nullptr, WNOHANG) >= 0 || errno != ECHILD; }

TEST(FrameWorkers, DeliverEveryFrameInOrder) {
  for (const int workers : {1, 2, 3, 4, 9}) {
    std::vector<int> seen;
    paint_in_order(23, 100, workers, number_painter, [&](int frame, const std::uint8_t* pixels) {
      seen.push_back(frame);
      for (int i = 0; i < 100; ++i) {
        ASSERT_EQ(pixels[i], static_cast<std::uint8_t>(frame * 7 + i));
      }
    });
    std::vector<int> expected(23);
    std::iota(expected.begin(), expected.end(), 0);
    EXPECT_EQ(seen, expected);
    EXPECT_FALSE(has_children());
  }
}

TEST(FrameWorkers, RepeatAWorkersError) {
  const auto prepare = []() -> PaintFrame { throw Error("no paint left"); };
  EXPECT_THAT([&] { paint_in_order(5, 10, 2, prepare, [](int, const std::uint8_t*) {}); },
              ThrowsMessage<Error>(HasSubstr("no paint left")));
  EXPECT_FALSE(has_children());
}

TEST(FrameWorkers, NoticeAKilledWorker) {
  const auto prepare = []() -> PaintFrame {
    return [](int frame, std::uint8_t*) {
      if (frame == 3) ::raise(SIGKILL);
    };
  };
  EXPECT_THAT([&] { paint_in_order(8, 10, 2, prepare, [](int, const std::uint8_t*) {}); },
              ThrowsMessage<Error>(HasSubstr("killed")));
  EXPECT_FALSE(has_children());
}

TEST(FrameWorkers, BeginsAfterItForkedAndBeforeAnythingIsPainted) {
  bool has_begun = false;
  const auto prepare = [&]() -> PaintFrame {
    return [&](int, std::uint8_t* pixels) { pixels[0] = has_begun ? 1 : 0; };
  };
  int seen_by_workers = 0;
  paint_in_order(
      6, 10, 2, prepare,
      [&](int, const std::uint8_t* pixels) {
        EXPECT_TRUE(has_begun);
        seen_by_workers += pixels[0];
      },
      [&] { has_begun = true; });
  EXPECT_EQ(seen_by_workers, 0) << "the workers know of nothing that came after the fork";
  EXPECT_THROW(paint_in_order(
                   6, 10, 2, prepare, [](int, const std::uint8_t*) { FAIL(); },
                   [] { throw std::runtime_error("no room"); }),
               std::runtime_error);
}

TEST(FrameWorkers, AreGoneWhenTheConsumerGivesUp) {
  EXPECT_THROW(paint_in_order(1000, 10, 3, number_painter,
                              [](int frame, const std::uint8_t*) {
                                if (frame == 5) throw Error("disk full");
                              }),
               Error);
  EXPECT_FALSE(has_children());
}

/// Kills a process while it paints: its workers must exit.
TEST(FrameWorkers, DieWithTheirParent) {
  int pipe_ends[2];
  ASSERT_EQ(::pipe(pipe_ends), 0);
  const pid_t parent = ::fork();
  if (parent == 0) {
    const auto prepare = [&]() -> PaintFrame {
      const pid_t self = ::getpid();
      (void)!::write(pipe_ends[1], &self, sizeof(self));
      return [](int, std::uint8_t*) { ::usleep(20'000); };
    };
    paint_in_order(100'000, 10, 2, prepare, [](int, const std::uint8_t*) {});
    ::_exit(0);
  }
  pid_t workers[2] = {0, 0};
  for (pid_t& worker : workers) {
    ASSERT_EQ(::read(pipe_ends[0], &worker, sizeof(worker)), static_cast<ssize_t>(sizeof(worker)));
  }
  ::kill(parent, SIGKILL);
  ::waitpid(parent, nullptr, 0);
  for (const pid_t worker : workers) {
    bool alive = true;
    for (int i = 0; alive && i < 3000; ++i) {
      // An orphan may stay a zombie until init collects it, and then counts as exited.
      std::string state;
      if (std::FILE* file =
              std::fopen(("/proc/" + std::to_string(worker) + "/stat").c_str(), "r")) {
        char text[512] = {};
        (void)!std::fread(text, 1, sizeof(text) - 1, file);
        std::fclose(file);
        state = text;
        alive = state.find(") Z") == std::string::npos;
      } else {
        alive = false;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_FALSE(alive);
  }
  ::close(pipe_ends[0]);
  ::close(pipe_ends[1]);
}

}  // namespace
}  // namespace touchdown::render
