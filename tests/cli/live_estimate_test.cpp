#include <algorithm>
#include <array>
#include <csignal>
#include <sstream>
#include <string_view>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "logs/log/recording_file.hpp"
#include "logs/log/writer.hpp"
#include "program.hpp"
#include "synthetic_log.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Runs `touchdown estimate - --estimator free_fall` with pipes at its input and output.
class LiveEstimate : public InFolder {
 protected:
  LiveEstimate() {
    std::array<int, 2> in = {};
    std::array<int, 2> out = {};
    if (::pipe(in.data()) != 0 || ::pipe(out.data()) != 0) return;
    program_ = ::fork();
    if (program_ == 0) {
      ::dup2(in[0], STDIN_FILENO);
      ::dup2(out[1], STDOUT_FILENO);
      for (const int end : {in[0], in[1], out[0], out[1]}) ::close(end);
      if (::freopen((folder_ / "errors").c_str(), "w", stderr) == nullptr) ::_exit(126);
      ::execl(TOUCHDOWN_PROGRAM, "touchdown", "estimate", "-", "--estimator", "free_fall", nullptr);
      ::_exit(127);
    }
    ::close(in[0]);
    ::close(out[1]);
    to_ = in[1];
    from_ = out[0];
  }

  void TearDown() override {
    if (program_ > 0) ::kill(program_, SIGKILL);
    close_input();
    ::close(from_);
    if (program_ > 0) ::waitpid(program_, nullptr, 0);
  }

  void send(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t written = ::write(to_, bytes.data(), bytes.size());
      ASSERT_GT(written, 0);
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
  }
  void close_input() {
    if (to_ >= 0) ::close(to_);
    to_ = -1;
  }

  /// Waits until the program has printed `lines` lines in total, or has ended. Returns its output.
  const std::string& wait_for_output(std::ptrdiff_t lines) {
    std::array<char, 4096> buffer = {};
    while (std::count(output_.begin(), output_.end(), '\n') < lines) {
      const ssize_t size = ::read(from_, buffer.data(), buffer.size());
      if (size <= 0) break;
      output_.append(buffer.data(), static_cast<std::size_t>(size));
    }
    return output_;
  }

  int exit_code() {
    int status = 0;
    ::waitpid(program_, &status, 0);
    program_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  pid_t program_ = -1;
  int to_ = -1;
  int from_ = -1;
  std::string output_;
};

/// The log's records, one text each.
std::vector<std::string> records(const logs::Recording& log) {
  std::ostringstream stream;
  logs::LogWriter writer(stream, log.info, logs::WrittenTruth{});
  std::vector<std::string> all;
  for (std::size_t k = 0; k < log.steps(); ++k) {
    writer.write(log.observation[k], log.action[k], nullptr);
    all.push_back(stream.str());
    stream.str("");
  }
  return all;
}

constexpr std::ptrdiff_t everything = 1'000'000;

TEST_F(LiveEstimate, PrintsALineForEveryRecordAsSoonAsItIsThere) {
  const std::vector<std::string> log = records(test::robot_log(0.3));
  // The rate is measured first, over 200 records.
  for (std::size_t k = 0; k < 200; ++k) send(log[k]);
  std::ptrdiff_t lines = 201;
  wait_for_output(lines);
  for (std::size_t k = 200; k < 210; ++k) {
    send(std::string_view(log[k]).substr(0, 100));
    send(std::string_view(log[k]).substr(100));
    const std::string& output = wait_for_output(++lines);
    ASSERT_EQ(std::count(output.begin(), output.end(), '\n'), lines) << "after record " << k;
    EXPECT_THAT(output, HasSubstr(fmt::format("\n{},", 0.001 * static_cast<double>(k))));
  }
  close_input();
  wait_for_output(everything);
  EXPECT_EQ(exit_code(), 0);
  EXPECT_THAT(folder_.text("errors"), HasSubstr("standard input: 210 steps"));
}

TEST_F(LiveEstimate, EndsInOrderOnCtrlC) {
  for (const std::string& record : records(test::robot_log(0.25))) send(record);
  wait_for_output(251);
  ::kill(program_, SIGINT);
  const std::string& output = wait_for_output(everything);
  EXPECT_EQ(std::count(output.begin(), output.end(), '\n'), 251);
  EXPECT_EQ(output.back(), '\n');
  EXPECT_EQ(exit_code(), 0);
  EXPECT_THAT(folder_.text("errors"),
              AllOf(HasSubstr("standard input: 250 steps"), HasSubstr("left wheel")));
}

TEST_F(LiveEstimate, PrintsTheBeliefsBeforeGarbage) {
  for (const std::string& record : records(test::robot_log(0.25))) send(record);
  send("garbage");
  close_input();
  const std::string& output = wait_for_output(everything);
  EXPECT_EQ(std::count(output.begin(), output.end(), '\n'), 251);
  EXPECT_EQ(exit_code(), 2);
  EXPECT_THAT(folder_.text("errors"), HasSubstr("standard input: byte "));
}

TEST_F(LiveEstimate, PrintsTheSameAsFromAFile) {
  const logs::Recording log = test::robot_log(0.7);
  std::ptrdiff_t sent = 0;
  for (const std::string& record : records(log)) {
    send(record);
    if (++sent >= 200)
      wait_for_output(sent + 1);  // a full pipe would block the program, and then the test
  }
  close_input();
  const std::string printed = wait_for_output(everything);
  EXPECT_EQ(exit_code(), 0);
  logs::write_recording(log, folder_ / "a.mpack");
  folder_.output_of("estimate a.mpack --estimator free_fall -o a.csv");
  EXPECT_EQ(printed, folder_.text("a.csv"));
}

}  // namespace
}  // namespace touchdown::cli
