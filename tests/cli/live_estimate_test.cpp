#include <algorithm>
#include <array>
#include <csignal>
#include <fcntl.h>
#include <optional>
#include <sstream>
#include <string_view>
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

/// `touchdown estimate - --estimator free_fall`, with a pipe at its input.
class LiveEstimate : public InFolder {
 public:
  ~LiveEstimate() override { close_input(); }

 protected:
  LiveEstimate() {
    std::array<int, 2> input = {};
    EXPECT_EQ(::pipe2(input.data(), O_CLOEXEC), 0);
    ::dup2(input[0], STDIN_FILENO);  // which the program inherits
    ::close(input[0]);
    to_ = input[1];
    program_.emplace("estimate - --estimator free_fall", folder_.path());
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
  /// Waits until the program has printed so many lines in total, or has ended. Returns its output.
  std::string wait_for_output(std::ptrdiff_t lines) {
    std::string output;
    program_->let_run_until([&] {
      output = folder_.text(".started.stdout");
      return std::count(output.begin(), output.end(), '\n') >= lines;
    });
    return output;
  }

  std::optional<StartedProgram> program_;
  int to_ = -1;
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

TEST_F(LiveEstimate, PrintsALineForEveryRecordAsSoonAsItIsThere) {
  const std::vector<std::string> log = records(test::robot_log(0.3));
  // The rate is measured first, over 200 records.
  for (std::size_t k = 0; k < 200; ++k) send(log[k]);
  std::ptrdiff_t lines = 201;
  wait_for_output(lines);
  for (std::size_t k = 200; k < 210; ++k) {
    send(std::string_view(log[k]).substr(0, 100));
    send(std::string_view(log[k]).substr(100));
    const std::string output = wait_for_output(++lines);
    ASSERT_EQ(std::count(output.begin(), output.end(), '\n'), lines) << "after record " << k;
    EXPECT_THAT(output, HasSubstr(fmt::format("\n{},", 0.001 * static_cast<double>(k))));
  }
  close_input();
  const Ended ended = program_->end();
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_THAT(ended.errors, HasSubstr("standard input: 210 steps"));
}

TEST_F(LiveEstimate, EndsInOrderOnCtrlC) {
  for (const std::string& record : records(test::robot_log(0.25))) send(record);
  wait_for_output(251);
  program_->send(SIGINT);
  const Ended ended = program_->end();
  EXPECT_EQ(std::count(ended.output.begin(), ended.output.end(), '\n'), 251);
  EXPECT_EQ(ended.output.back(), '\n');
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_THAT(ended.errors, AllOf(HasSubstr("standard input: 250 steps"), HasSubstr("left wheel")));
}

TEST_F(LiveEstimate, PrintsTheSameAsFromAFileAlsoBeforeGarbage) {
  const logs::Recording log = test::robot_log(0.7);
  for (const std::string& record : records(log)) send(record);
  send("garbage");
  close_input();
  const Ended ended = program_->end();
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(ended.errors, HasSubstr("standard input: byte "));
  logs::write_recording(log, folder_ / "a.mpack");
  folder_.output_of("estimate a.mpack --estimator free_fall -o a.csv");
  EXPECT_EQ(ended.output, folder_.text("a.csv"));
}

}  // namespace
}  // namespace touchdown::cli
