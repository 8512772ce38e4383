#include "apps/viewer/label_editor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::viewer {
namespace {

using logs::LabelState;
using ::testing::HasSubstr;

/// A second at 1 kHz with a gap of 0.2 s after 0.4 s.
LogClock clock_with_gap() {
  std::vector<double> times;
  for (int k = 0; k < 1000; ++k) times.push_back(0.001 * k + (k < 400 ? 0.0 : 0.2));
  return {times, 0.001};
}

class EditedLabels : public ::testing::Test {
 protected:
  LabelEditor editor_of(const std::string& rows) const {
    const auto path = folder_.write("l.csv", "start,end,left,right,sure\n" + rows);
    return {logs::read_begun_intervals(path), clock_with_gap()};
  }
  std::string saved() const { return read_file(folder_ / "l.csv").substr(26); }

  const ScratchFolder folder_;
};

TEST_F(EditedLabels, AreVisitedFromTheLeastSureOn) {
  LabelEditor editor = editor_of("0,.1,1,1,.9\n.1,.2,0,0,.7\n.2,.3,1,0,.8\n.3,.4,1,1,1\n");
  EXPECT_EQ(editor.next_least_sure(false), .1);
  EXPECT_EQ(editor.next_least_sure(false), .2);
  EXPECT_EQ(editor.next_least_sure(false), 0);
  EXPECT_EQ(editor.next_least_sure(false), .1) << "from the first on again";
  EXPECT_EQ(editor.next_least_sure(true), 0);
  EXPECT_EQ(editor.next_least_sure(true), .2);
  EXPECT_EQ(editor.accept(), 0) << "the next one";
  EXPECT_EQ(editor.accept(), .1);
  EXPECT_EQ(editor.accept(), std::nullopt) << "all are accepted";
  EXPECT_EQ(saved(), "0,0.1,1,1,1.000\n0.1,0.2,0,0,1.000\n0.2,0.3,1,0,1.000\n0.3,0.4,1,1,1.000\n");
}

TEST_F(EditedLabels, TheWheelWithAnEdgeOfTheIntervalIsChosen) {
  LabelEditor editor = editor_of("0,.1,1,1,1\n.1,.2,1,0,.7\n.2,.3,1,1,1\n");
  editor.next_least_sure(false);
  EXPECT_EQ(editor.wheel(), 1U);
}

TEST_F(EditedLabels, EdgesMoveByStepsOfTheLogAlsoOverItsGaps) {
  LabelEditor editor = editor_of("0,.395,1,1,1\n.395,1,0,0,1\n");
  EXPECT_EQ(editor.next_edge(0.1, false), .395);
  EXPECT_EQ(editor.nudge(4), .399);
  EXPECT_EQ(editor.nudge(1), .6) << "the step after the gap";
  EXPECT_EQ(editor.nudge(-10), .39);
  EXPECT_EQ(saved(), "0,0.39,1,1,1.000\n0.39,0.395,0,1,1.000\n0.395,1,0,0,1.000\n");
  EXPECT_EQ(editor.next_edge(0.0, true), 0);
  EXPECT_EQ(editor.nudge(-1), 0) << "the log's start";
}

TEST_F(EditedLabels, ADragIsOneEditFromWhereItBegan) {
  LabelEditor editor = editor_of("0,.1,1,1,1\n.1,.2,0,0,1\n.2,.3,1,1,1\n");
  ASSERT_TRUE(editor.select_edge(0, .1004, .001));
  EXPECT_FALSE(editor.select_edge(0, .15, .001));
  const std::string before = saved();
  for (const double to : {.15, .9, .02, .1207}) editor.drag(to);
  EXPECT_EQ(saved(), before) << "not yet";
  editor.drop();
  EXPECT_EQ(saved(),
            "0,0.1,1,1,1.000\n0.1,0.121,1,0,1.000\n0.121,0.2,0,0,1.000\n0.2,0.3,1,1,1.000\n");
  EXPECT_TRUE(editor.undo());
  EXPECT_EQ(saved(), "0,0.1,1,1,1.000\n0.1,0.2,0,0,1.000\n0.2,0.3,1,1,1.000\n");
  EXPECT_FALSE(editor.undo());
  EXPECT_TRUE(editor.redo());
}

TEST_F(EditedLabels, AMarkedIntervalEndsAtThePresentInEitherDirection) {
  LabelEditor editor({(folder_ / "l.csv").string(), {}}, clock_with_gap());
  editor.mark_begin(.1);
  editor.set(LabelState::air, false, .05);
  EXPECT_FALSE(editor.mark());
  EXPECT_EQ(read_file(folder_ / "l.csv"), "start,end,left,right\n0.05,0.1,0,0\n");
  editor.mark_begin(.2);
  editor.mark_begin(.2);
  EXPECT_FALSE(editor.mark()) << "marked twice: none";
  editor.set(LabelState::unknown, true, .07);
  EXPECT_EQ(read_file(folder_ / "l.csv"), "start,end,left,right\n");
  EXPECT_THAT(editor.finish(), HasSubstr("2 edits saved; 0 intervals"));
}

TEST_F(EditedLabels, ThatCannotBeSavedAreReportedAndKept) {
  folder_.write("file", "");
  LabelEditor editor({(folder_ / "file" / "l.csv").string(), {}}, clock_with_gap());
  editor.set(LabelState::contact, true, .1);
  EXPECT_THAT(editor.problem(), HasSubstr("l.csv"));
  EXPECT_EQ(editor.labels().intervals.size(), 1U);
  EXPECT_THROW((void)editor.finish(), Error);
}

TEST_F(EditedLabels, ThatNothingChangedAreNotWritten) {
  LabelEditor editor({(folder_ / "none.csv").string(), {}}, clock_with_gap());
  editor.split(.3);
  editor.next_least_sure(false);
  editor.accept();
  EXPECT_THAT(editor.finish(), HasSubstr("not changed"));
  EXPECT_FALSE(is_there(folder_ / "none.csv"));
}

}  // namespace
}  // namespace touchdown::viewer
