#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>

#include "apps/viewer/label_editor.hpp"
#include "apps/viewer/watch.hpp"
#include "logs/log/recording_file.hpp"
#include "scoring/labels.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::viewer {
namespace {

/// A person who sees the truth and corrects proposed labels with the window's keys.
class Person {
 public:
  Person(LabelEditor& editor, const logs::Recording& recording)
      : editor_(editor), truth_(scoring::contact_labels(recording, {})) {}

  int keys = 0;

  void correct() {
    for (std::optional<double> here = press(editor_.next_least_sure(false)); here;
         here = press(editor_.accept())) {
      present_ = *here;
      const logs::TimeRange looked_at = editor_.selection()->range;
      correct_within(looked_at.begin - 0.1, looked_at.end + 0.1);
    }
    keys += static_cast<int>(editor_.clock().range().end);  // looks through it: Shift → each second
    correct_within(-1.0, 1e9);
  }

  /// The first wrong steps [begin, end) of a wheel, more than 5 ms of them.
  std::optional<StepRange> wrong(std::size_t wheel, double from, double to) const {
    std::vector<std::uint8_t> differs;
    for (std::size_t k = 0; k < truth_[wheel].size(); ++k) {
      const auto is = logs::state_at(editor_.labels(), editor_.clock().time_of(k), wheel);
      const auto should = truth_[wheel][k] != 0 ? logs::LabelState::contact : logs::LabelState::air;
      differs.push_back(is == should ? 0 : 1);
    }
    for (const StepRange& range : ranges_of(differs)) {
      const double begin = editor_.clock().time_of(range.begin);
      if (range.end - range.begin > 5 && begin >= from && begin < to) return range;
    }
    return std::nullopt;
  }

 private:
  template <typename T>
  T press(T result) {
    ++keys;
    return result;
  }

  void correct_within(double from, double to) {
    for (std::size_t wheel = 0; wheel < 2; ++wheel) {
      for (auto range = wrong(wheel, from, to); range; range = wrong(wheel, from, to)) {
        correct(wheel, *range);
      }
    }
  }

  /// Goes to a time: seconds, tenths, ten steps, steps until it is 2 ms off.
  void go_to(double time) {
    double left = std::abs(time - present_);
    for (const double step : {1.0, 0.1, 0.01}) {
      const double count = std::floor(left / step + 0.5);
      keys += static_cast<int>(count);
      left = std::abs(left - count * step);
    }
    keys += static_cast<int>(std::max(0.0, std::ceil((left - 0.002) / 0.001)));
    present_ = time;
  }

  void correct(std::size_t wheel, const StepRange& range) {
    const double begin = editor_.clock().time_of(range.begin);
    const double end = editor_.clock().time_of(range.end);
    if (editor_.wheel() != wheel) {
      editor_.change_wheel();
      ++keys;
    }
    const std::vector<double> edges = logs::edges_of(editor_.labels(), wheel);
    const auto is_edge = [&](double t) {
      return std::binary_search(edges.begin(), edges.end(), t);
    };
    const auto should =
        truth_[wheel][range.begin] != 0 ? logs::LabelState::contact : logs::LabelState::air;
    if (is_edge(begin) != is_edge(end)) {
      const double edge = is_edge(begin) ? begin : end;
      go_to_edge(wheel, edge);
      const int steps = static_cast<int>(range.end - range.begin) * (is_edge(begin) ? 1 : -1);
      for (int rest = steps; rest != 0;) {
        const int size = std::abs(rest) >= 6 ? 10 : 1;
        const int by = rest > 0 ? size : -size;
        if (std::abs(rest) <= 2) break;
        editor_.nudge(by);
        ++keys;
        rest -= by;
      }
      present_ = edge;
      return;
    }
    if (is_edge(begin)) {  // an interval that is none
      go_to_edge(wheel, begin);
      present_ = begin;
      press((editor_.set(should, false, begin), 0));
      return;
    }
    go_to(begin);
    press((editor_.mark_begin(begin), 0));
    go_to(end);
    press((editor_.set(should, false, end), 0));
  }

  void go_to_edge(std::size_t wheel, double edge) {
    const std::vector<double> edges = logs::edges_of(editor_.labels(), wheel);
    const auto between = std::count_if(edges.begin(), edges.end(), [&](double t) {
      return t > std::min(edge, present_) && t < std::max(edge, present_);
    });
    keys += static_cast<int>(
                std::min<double>(static_cast<double>(between), std::abs(edge - present_) + 5.0)) +
            1;
    ASSERT_TRUE(editor_.select_edge(wheel, edge, 1e-4));
  }

  LabelEditor& editor_;
  std::array<scoring::ContactSequence, models::wheel_count> truth_;
  double present_ = 0.0;
};

/// The longest time that a file of labels is wrong in one go, over both wheels (s).
double longest_error(const std::filesystem::path& labels, const logs::Recording& recording) {
  const auto truth = scoring::contact_labels(recording, {});
  std::array<std::vector<int>, models::wheel_count> written = {
      std::vector<int>(truth[0].size(), -1), std::vector<int>(truth[1].size(), -1)};
  std::ifstream file(labels);
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    double start = 0.0;
    double end = 0.0;
    std::array<int, 2> contact{};
    EXPECT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%d,%d", &start, &end, &contact[0], &contact[1]),
              4);
    for (auto k = std::lround(1e3 * start); k < std::lround(1e3 * end); ++k) {
      for (std::size_t w = 0; w < 2; ++w)
        written.at(w).at(static_cast<std::size_t>(k)) = contact.at(w);
    }
  }
  int longest = 0;
  for (std::size_t w = 0; w < 2; ++w) {
    int wrong = 0;
    for (std::size_t k = 0; k < truth.at(w).size(); ++k) {
      wrong = written.at(w)[k] == truth.at(w)[k] ? 0 : wrong + 1;
      longest = std::max(longest, wrong);
    }
  }
  return 1e-3 * longest;
}

TEST(ALog, IsLabelledToFiveMillisecondsFromProposalsByFewKeys) {
  const ScratchFolder folder;
  const auto log = folder / "run.mpack";
  const auto labels = folder / "labels.csv";
  const std::string program = "cd '" TOUCHDOWN_SOURCE_DIR "' && " TOUCHDOWN_PROGRAM " ";
  ASSERT_EQ(std::system((program + "simulate drawn:put_downs_11_000 -o '" + log.string() +
                         "' >/dev/null && " + program + "estimate '" + log.string() +
                         "' --propose '" + labels.string() + "' >/dev/null")
                            .c_str()),
            0);
  const logs::Recording recording = logs::read_recording(log);
  EXPECT_GT(longest_error(labels, recording), 0.005) << "nothing to correct";
  std::vector<double> times;
  for (const auto& row : recording.observation) times.push_back(row.time);
  LabelEditor editor(logs::read_contact_intervals(labels), LogClock(times, recording.period()));
  Person person(editor, recording);
  person.correct();
  EXPECT_LE(longest_error(labels, recording), 0.005);
  EXPECT_LT(person.keys, 15.0 * times.back());
}

}  // namespace
}  // namespace touchdown::viewer
