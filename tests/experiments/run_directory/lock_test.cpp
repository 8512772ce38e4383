#include "experiments/run_directory/lock.hpp"

#include <cerrno>
#include <csignal>
#include <optional>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "tests/scratch_folder.hpp"

/// A file system without locks, such as some of clusters, for one thread.
static thread_local bool has_no_locks = false;

/// Replaces that of the C library.
extern "C" int flock(int descriptor, int operation) {
  if (!has_no_locks) return static_cast<int>(::syscall(SYS_flock, descriptor, operation));
  errno = ENOLCK;
  return -1;
}

namespace touchdown::experiments {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

namespace fs = std::filesystem;

struct Lock : ::testing::Test {
  DirectoryLock take(Access access, const std::string& command = "touchdown run x.yaml") const {
    return {folder.path(), access, command};
  }
  bool is_free(Access access) const {
    try {
      take(access);
      return true;
    } catch (const Error&) {
      return false;
    }
  }
  const ScratchFolder folder;
};

TEST_F(Lock, NoticesThatItsDirectoryWasMovedOrReplaced) {
  const fs::path place = folder / "run";
  const auto held = [&] {
    fs::create_directories(place);
    return DirectoryLock(place, Access::shared, "touchdown run x.yaml");
  };
  const DirectoryLock moved = held();
  EXPECT_TRUE(moved.is_in_place());
  fs::rename(place, folder / "elsewhere");
  EXPECT_FALSE(moved.is_in_place());
  const DirectoryLock other = held();  // a new directory at the old place
  EXPECT_TRUE(other.is_in_place());
  EXPECT_FALSE(moved.is_in_place());
  fs::remove_all(place);
  EXPECT_FALSE(other.is_in_place());
  fs::rename(folder / "elsewhere", place);
  EXPECT_TRUE(moved.is_in_place());
  EXPECT_TRUE(DirectoryLock::for_reading(folder / "nowhere", "x").is_in_place());
}

TEST_F(Lock, HeldAloneRefusesAllOthersAndNamesItsHolder) {
  std::optional<DirectoryLock> held = take(Access::alone, "touchdown run\tx.yaml\n--out a");
  EXPECT_FALSE(is_free(Access::alone));
  EXPECT_FALSE(is_free(Access::shared));
  EXPECT_THAT(
      [&] { take(Access::shared); },
      ThrowsMessage<Error>(AllOf(HasSubstr(folder.path().string() + ": is in use by process "),
                                 HasSubstr(std::to_string(::getpid())), HasSubstr("since 2"),
                                 HasSubstr("(touchdown run x.yaml --out a)"))));
  held.reset();
  EXPECT_TRUE(is_free(Access::alone));
}

TEST_F(Lock, IsSharedOnRequestAndKeptByTheLastCopy) {
  std::optional<DirectoryLock> first = take(Access::shared, "touchdown run --shard 1/2");
  std::optional<DirectoryLock> second = take(Access::shared, "touchdown run --shard 2/2");
  EXPECT_THAT([&] { take(Access::alone); }, ThrowsMessage<Error>(HasSubstr("--shard 2/2")));
  second.reset();
  EXPECT_FALSE(is_free(Access::alone));
  const DirectoryLock copy = *first;
  first.reset();
  EXPECT_FALSE(is_free(Access::alone));
}

TEST_F(Lock, IsWaitedForIfAsked) {
  std::optional<DirectoryLock> held = take(Access::alone);
  bool taken = false;
  std::thread other([&] {
    try {
      const DirectoryLock waited(folder.path(), Access::shared, "other", std::chrono::seconds(30));
      taken = true;
    } catch (const Error&) {
      taken = false;
    }
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  held.reset();
  other.join();
  EXPECT_TRUE(taken);
}

TEST_F(Lock, OfAKilledProcessIsGone) {
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t holder = ::fork();
  if (holder == 0) {
    const DirectoryLock held = take(Access::alone, "touchdown run killed.yaml");
    [[maybe_unused]] const auto written = ::write(ready[1], "x", 1);
    for (;;) ::pause();
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  EXPECT_THAT([&] { take(Access::alone); },
              ThrowsMessage<Error>(
                  AllOf(HasSubstr("process " + std::to_string(holder)), HasSubstr("killed.yaml"))));
  ::kill(holder, SIGKILL);
  ::waitpid(holder, nullptr, 0);
  EXPECT_TRUE(is_free(Access::alone));
  ::close(ready[0]);
  ::close(ready[1]);
}

TEST_F(Lock, OfAKilledProcessIsWaitedForWhileItsChildrenDie) {
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t holder = ::fork();
  if (holder == 0) {
    const DirectoryLock held = take(Access::alone);
    if (::fork() == 0) {
      // Outlives its parent, as a busy process does after a signal.
      ::usleep(300'000);
      ::_exit(0);
    }
    [[maybe_unused]] const auto written = ::write(ready[1], "x", 1);
    for (;;) ::pause();
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  EXPECT_FALSE(is_free(Access::alone));
  ::kill(holder, SIGKILL);
  ::waitpid(holder, nullptr, 0);
  EXPECT_TRUE(is_free(Access::alone));
  ::close(ready[0]);
  ::close(ready[1]);
}

TEST_F(Lock, EndsWhenItsDirectoryIsRemoved) {
  const DirectoryLock held = take(Access::alone);
  fs::remove_all(folder / "state");
  EXPECT_TRUE(is_free(Access::alone));
}

TEST_F(Lock, ForReadingMakesNoFileAndIsRefusedDuringWrites) {
  DirectoryLock::for_reading(folder.path(), "touchdown render");
  EXPECT_TRUE(fs::is_empty(folder.path()));
  std::optional<DirectoryLock> held = take(Access::alone, "touchdown run");
  EXPECT_THAT([&] { DirectoryLock::for_reading(folder.path(), "touchdown render"); },
              ThrowsMessage<Error>(HasSubstr("(touchdown run)")));
  held.reset();
  const DirectoryLock reading = DirectoryLock::for_reading(folder.path(), "touchdown render");
  EXPECT_THAT([&] { take(Access::alone); }, ThrowsMessage<Error>(HasSubstr("render")));
  EXPECT_TRUE(is_free(Access::shared));
}

TEST_F(Lock, ThatAFileSystemDoesNotKnowIsAWarning) {
  take(Access::alone);  // makes the file
  for (const bool reads : {false, true}) {
    testing::internal::CaptureStderr();
    has_no_locks = true;
    const DirectoryLock lock =
        reads ? DirectoryLock::for_reading(folder.path(), "x") : take(Access::alone);
    has_no_locks = false;
    EXPECT_THAT(testing::internal::GetCapturedStderr(),
                AllOf(HasSubstr("state/lock: cannot be locked: No locks available"),
                      HasSubstr("start no other command")));
    EXPECT_TRUE(lock.is_in_place());
  }
}

TEST_F(Lock, IsNotTakenThroughALink) {
  folder.write("precious", "x");
  fs::create_directories(folder / "state");
  fs::create_symlink(folder / "precious", folder / "state/lock");
  EXPECT_FALSE(is_free(Access::alone));
  EXPECT_EQ(read_file(folder / "precious"), "x");
}

}  // namespace
}  // namespace touchdown::experiments
