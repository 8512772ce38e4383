#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "render/gnuplot/figure.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::render {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

/// Sets an environment variable for the lifetime of this object.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    ::setenv(name, value.c_str(), 1);
  }
  ~Variable() { before_ ? ::setenv(name_, before_->c_str(), 1) : ::unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

std::map<std::string, std::string> files_in(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    files[entry.path().filename().string()] =
        entry.is_regular_file() ? read_file(entry.path()) : "";
  }
  return files;
}

class WholeFigures : public ::testing::Test {
 protected:
  void draw(const std::string& commands = "plot x\n") const {
    draw_figure(folder_ / "line", 300, 200, commands, {{"line.dat", "1\t2\n"}});
  }
  /// A gnuplot that draws, truncates its output, and reports success, as the real one does when the
  /// disk is full.
  std::string path_with_cutting_gnuplot(const std::string& victim) const {
    const fs::path program = tools_ / "gnuplot";
    std::ofstream(program) << "#!/bin/sh\nPATH=" << std::getenv("PATH")
                           << "\ngnuplot \"$@\" || exit\nfor f in " << victim
                           << "; do head -c 200 $f >cut; mv cut $f; done\n";
    fs::permissions(program, fs::perms::owner_all);
    return tools_.path().string() + ":" + std::getenv("PATH");
  }

  const ScratchFolder scratch_, tools_;
  const fs::path folder_ = scratch_.path();
};

TEST_F(WholeFigures, AnUnfinishedDrawingDoesNotReplaceThePreviousOne) {
  draw();
  const auto before = files_in(folder_);
  ASSERT_EQ(before.size(), 5U);
  for (const char* victim : {"line.png", "line.svg", "line.pdf"}) {
    const Variable path("PATH", path_with_cutting_gnuplot(victim));
    EXPECT_THAT(
        [&] { draw("plot -x\n"); },
        ThrowsMessage<Error>(AllOf(HasSubstr((folder_ / victim).string()),
                                   HasSubstr("cannot be written"), Not(HasSubstr(".part")))));
    EXPECT_TRUE(files_in(folder_) == before) << victim;
  }
}

TEST_F(WholeFigures, AFullDiskIsAnErrorThatNamesTheFileAndLeavesNothing) {
  draw();
  const auto before = files_in(folder_);
  const pid_t child = ::fork();
  if (child == 0) {
    // A limit on the size of all files of this process and of the programs that it starts.
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit most{1000, 1000};
    ::setrlimit(RLIMIT_FSIZE, &most);
    try {
      draw("plot -x\n");
    } catch (const Error& error) {
      const std::string message = error.what();
      const bool named = message.find((folder_ / "line").string() + ".") != std::string::npos;
      ::_exit(named && message.find("cannot be written") != std::string::npos ? 42 : 1);
    }
    ::_exit(0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 42);
  EXPECT_TRUE(files_in(folder_) == before);
}

TEST_F(WholeFigures, UserSettingsOfGnuplotAreIgnored) {
  draw();
  const std::string before = read_file(folder_ / "line.png");
  const std::string marker = (tools_ / "was_here").string();
  std::ofstream(tools_ / ".gnuplot")
      << "system 'touch " << marker << "'\nset samples 2\nset border 0\n";
  const Variable home("HOME", tools_.path().string());
  draw();
  EXPECT_FALSE(fs::exists(marker));
  EXPECT_TRUE(read_file(folder_ / "line.png") == before);
}

TEST_F(WholeFigures, AreTheSameInEveryTimeZone) {
  const Variable here("TZ", "UTC0");
  draw();
  const auto before = files_in(folder_);
  for (const char* zone : {"Asia/Kolkata", "America/St_Johns", "XXX-5:30"}) {
    const Variable there("TZ", zone);
    draw();
    EXPECT_TRUE(files_in(folder_) == before) << zone;
  }
}

TEST_F(WholeFigures, FilesOfTheUserAreNotReplaced) {
  std::ofstream(folder_ / "style.gp") << "mine";
  draw();
  EXPECT_EQ(read_file(folder_ / "style.gp"), "mine");
  draw();  // its own files it may replace
  for (const char* name : {"results.dat", "results.gp", "results.pdf"}) {
    std::ofstream(folder_ / name) << "mine";
    EXPECT_THAT(
        [&] {
          draw_figure(folder_ / "results", 300, 200, "plot x\n", {{"results.dat", "1\n"}});
        },
        ThrowsMessage<InputError>(
            AllOf(HasSubstr((folder_ / name).string()), HasSubstr("another name"))));
    EXPECT_EQ(read_file(folder_ / name), "mine");
    EXPECT_FALSE(fs::exists(folder_ / "results.png"));
    fs::remove(folder_ / name);
  }
}

TEST_F(WholeFigures, AreTheSameWheneverTheyAreDrawn) {
  draw();
  const auto before = files_in(folder_);
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // a PDF's date counts seconds
  draw();
  EXPECT_TRUE(files_in(folder_) == before);
}

}  // namespace
}  // namespace touchdown::render
