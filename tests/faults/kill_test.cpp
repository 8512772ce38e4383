#include <csignal>
#include <functional>
#include <iostream>
#include <memory>
#include <random>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/started_program.hpp"
#include "tests/faults/outcome.hpp"
#include "tests/faults/small_experiment.hpp"

namespace touchdown::faults {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

namespace fs = std::filesystem;

using Command = std::function<std::string(const ScratchFolder&)>;

/// The point in a stage from which the waiting time until a kill counts.
enum class From { any_call, last_call, start };

/// A part of a program's work, identified by the files that it writes: their paths contain `only`.
struct Stage {
  const char* name;
  Command command;
  const char* only;
  double longest_wait;  ///< (s)
  From from = From::any_call;
  bool grows = false;         ///< its files are complete more than once
  bool leaves_parts = false;  ///< partial files in a folder of the user
};

/// Kills programs in one stage, and counts kills and differing files.
class Kills {
 public:
  explicit Kills(const Stage& stage) : stage_(stage) {
    const ScratchFolder folder;
    const Injection injection(folder.path());
    watch(injection);
    const cli::Ended end =
        cli::StartedProgram(stage.command(folder), folder.path(), injection.environment()).end();
    EXPECT_EQ(end.exit_code, 0) << end.errors;
    expected_ = files_of(folder / "a");
    calls_ = injection->seen;
    EXPECT_GT(calls_, 0U) << stage.name;
  }

  /// Kills the program once, at or after a random call, and lets the same command finish.
  void kill(std::mt19937& random) {
    const ScratchFolder folder;
    const std::string command = stage_.command(folder);
    const Injection injection(folder.path());
    watch(injection);
    const std::uint64_t any = std::uniform_int_distribution<std::uint64_t>(1, calls_)(random);
    const double wait = std::uniform_real_distribution<double>(0.0, stage_.longest_wait)(random);
    const bool kill_at_call = stage_.from == From::any_call && random() % 2 == 0;
    const std::uint64_t at = stage_.from == From::any_call ? any
                             : stage_.from == From::start  ? 0
                                                           : calls_;
    if (kill_at_call) {
      injection->nth = at;
      injection->kills = true;
    }
    cli::StartedProgram program(command, folder.path(), injection.environment());
    while (program.is_running() && injection->seen < at) program.let_run(0.0005);
    if (!kill_at_call) {
      program.let_run(wait);
      program.send(SIGKILL);
    }
    if (program.end().exit_code == -SIGKILL) ++kills_;
    Files left = files_of(folder / "a");
    if (stage_.grows) left.clear();  // the files of a training grow with every iteration
    std::vector<std::string> wrong = half_written(left, expected_);
    if (stage_.leaves_parts) {
      for (const std::string& part : parts_in(folder / "a")) fs::remove_all(folder / "a" / part);
    }
    for (const std::string& one :
         wrong_after(cli::StartedProgram(command, folder.path()).end(), folder / "a", expected_)) {
      wrong.push_back(one);
    }
    EXPECT_THAT(wrong, IsEmpty()) << stage_.name << " killed at " << at << " of " << calls_
                                  << (kill_at_call ? "" : fmt::format(" and {:.4f} s", wait));
    wrong_ += wrong.size();
  }

  ~Kills() {
    std::cout << fmt::format("{}: {} kills, {} differing files\n", stage_.name, kills_, wrong_);
  }
  Kills(const Kills&) = delete;
  Kills& operator=(const Kills&) = delete;

  int kills() const { return kills_; }

 private:
  void watch(const Injection& injection) const {
    injection->counted = all_files & ~bit(Kind::read);
    std::string_view(stage_.only).copy(injection->only.data(), injection->only.size() - 1);
  }

  const Stage& stage_;
  Files expected_;
  std::uint64_t calls_ = 0;
  int kills_ = 0;
  std::size_t wrong_ = 0;
};

void expect_recovery(const Stage& stage, int some, int all) {
  std::mt19937 random(20261122);
  Kills kills(stage);
  const int count = all_of_them() ? all : some;
  for (int i = 0; i < count; ++i) kills.kill(random);
  EXPECT_GT(kills.kills(), 0);
}

/// Two shards, and the results of both.
std::string finish(const ScratchFolder& folder) {
  const std::string run = small_run_without_pictures(folder);
  if (!fs::exists(folder / "a")) {
    for (const char* shard : {" --shard 1/2", " --shard 2/2"}) {
      const cli::Ended end = cli::StartedProgram(run + shard, folder.path()).end();
      EXPECT_EQ(end.exit_code, 0) << end.errors;
    }
  }
  return "run a --no-pictures";
}

TEST(Kills, WhileItSimulates) {
  expect_recovery({"simulating", small_run_without_pictures, "/recordings/", 0.02}, 3, 30);
}

TEST(Kills, WhileItEvaluates) {
  expect_recovery({"evaluating", small_run_without_pictures, "/evaluation/", 0.01}, 1, 15);
}

TEST(Kills, WhileItWritesModels) {
  expect_recovery({"models", small_run_without_pictures, "/models/", 0.01}, 1, 10);
}

TEST(Kills, WhileItWritesTables) {
  expect_recovery({"tables", small_run_without_pictures, "/tables/", 0.01}, 1, 15);
}

TEST(Kills, WhileItDraws) { expect_recovery({"drawing", small_run, "/figures/", 0.1}, 1, 20); }

TEST(Kills, WhileItFilms) {
  expect_recovery({"filming", small_film, "", 1.0, From::start, false, true}, 1, 10);
  if (!all_of_them()) return;
  expect_recovery({"filming a run", small_run_with_film, "/figures/", 2.0, From::last_call}, 0, 10);
}

TEST(Kills, WhileItRunsClosedLoops) {
  expect_recovery({"closed loop", small_closed_loop, "/closed_loop/", 0.02}, 1, 15);
}

TEST(Kills, WhileItFinishesShards) { expect_recovery({"finishing", finish, "", 0.02}, 1, 15); }

#ifdef TOUCHDOWN_HAS_TRAINER
TEST(Kills, WhileItTrains) {
  expect_recovery({"training", small_training, "", 0.2, From::any_call, true}, 1, 20);
}
#endif

/// Starts a command and waits until it has made `calls` calls.
std::unique_ptr<cli::StartedProgram> started(const std::string& command,
                                             const ScratchFolder& folder,
                                             const Injection& injection, std::uint64_t calls) {
  injection->counted = all_files & ~bit(Kind::read);
  auto program =
      std::make_unique<cli::StartedProgram>(command, folder.path(), injection.environment());
  while (program->is_running() && injection->seen < calls) program->let_run(0.0005);
  return program;
}

/// The small run, started in folder `from`, where its messages go, into the directory of `folder`.
std::string run_into(const ScratchFolder& folder, const ScratchFolder& from) {
  small_run(from);
  return "run small.yaml --no-pictures --out " + (folder / "a").string();
}

/// Two programs in one directory at the same time; the first is killed.
struct Together : ::testing::Test {
  Together() {
    const ScratchFolder alone;
    const cli::Ended end =
        cli::StartedProgram(small_run_without_pictures(alone), alone.path()).end();
    EXPECT_EQ(end.exit_code, 0) << end.errors;
    expected = files_of(alone / "a");
  }
  int times(int some, int all) const { return all_of_them() ? all : some; }

  Files expected;
  std::mt19937 random{20261122};
};

TEST_F(Together, AShardThatIsKilledBesideAnotherIsComputedAgain) {
  int kills = 0;
  for (int i = 0; i < times(1, 10); ++i) {
    const ScratchFolder folder;
    const ScratchFolder elsewhere;
    const std::string run = small_run_without_pictures(folder);
    const Injection injection(folder.path());
    // The shard makes more than a hundred calls.
    const auto first = started(run + " --shard 2/2", folder, injection, 1 + random() % 100);
    cli::StartedProgram second(run_into(folder, elsewhere) + " --shard 1/2", elsewhere.path());
    first->let_run(0.0005 * static_cast<double>(random() % 100));
    first->send(SIGKILL);
    kills += first->end().exit_code == -SIGKILL ? 1 : 0;
    const cli::Ended end = second.end();
    EXPECT_EQ(end.exit_code, 0) << end.errors;
    EXPECT_EQ(cli::StartedProgram(run + " --shard 2/2", folder.path()).end().exit_code, 0);
    EXPECT_THAT(wrong_after(cli::StartedProgram("run a --no-pictures", folder.path()).end(),
                            folder / "a", expected),
                IsEmpty());
  }
  EXPECT_GT(kills, 0);
  std::cout << fmt::format("one of two shards: {} kills\n", kills);
}

TEST_F(Together, ASecondRunIsRefusedAndContinuesOnceTheFirstIsKilled) {
  int kills = 0;
  for (int i = 0; i < times(1, 10); ++i) {
    const ScratchFolder folder;
    const ScratchFolder elsewhere;
    const std::string run = small_run_without_pictures(folder);
    const Injection injection(folder.path());
    constexpr std::uint64_t with_lock = 20;
    const auto first = started(run, folder, injection, with_lock + random() % 80);
    first->send(SIGSTOP);
    const cli::Ended refused =
        cli::StartedProgram(run_into(folder, elsewhere), elsewhere.path()).end();
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.errors, HasSubstr("is in use by process "));
    first->send(SIGKILL);
    kills += first->end().exit_code == -SIGKILL ? 1 : 0;
    EXPECT_THAT(wrong_after(cli::StartedProgram(run, folder.path()).end(), folder / "a", expected),
                IsEmpty());
  }
  EXPECT_GT(kills, 0);
  std::cout << fmt::format("beside a run that is refused: {} kills\n", kills);
}

}  // namespace
}  // namespace touchdown::faults
