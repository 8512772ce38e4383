// Limits and signals of the system, special files, texts and numbers without meaning.

#include <csignal>
#include <sys/stat.h>
#include <sys/wait.h>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "logs/log/recording_file.hpp"
#include "started_program.hpp"
#include "synthetic_log.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

namespace fs = std::filesystem;

/// As `touchdown_program`, after a command of the shell, such as `ulimit`. The exit code is minus
/// the signal's number if a signal ended the program.
Ended after(const std::string& shell, const std::string& arguments, const ScratchFolder& folder) {
  const std::string command =
      fmt::format("cd '{}' && {{ {} && exec '{}' {}; }} >.stdout 2>.stderr", folder.path().string(),
                  shell, TOUCHDOWN_PROGRAM, arguments);
  const int status = std::system(command.c_str());
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  return {code, read_file(folder / ".stdout"), read_file(folder / ".stderr")};
}

std::string last_line(std::string text) {
  while (text.ends_with('\n')) text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

class Limits : public ::testing::Test {
 protected:
  Limits() { logs::write_recording(test::synthetic_log(2.0), folder_ / "a.mpack"); }

  /// The one line about a request that is refused.
  std::string refusal(const std::string& arguments, int code = 2) const {
    const Ended ended = touchdown_program(arguments, folder_.path());
    EXPECT_EQ(ended.exit_code, code) << arguments << ": " << ended.errors;
    EXPECT_EQ(std::count(ended.errors.begin(), ended.errors.end(), '\n'), 1) << ended.errors;
    return ended.errors;
  }

  const ScratchFolder folder_;
};

TEST_F(Limits, OfTheSizeOfFilesFailAWriteThatNamesItsFile) {
  const auto limited = [&](const std::string& arguments) {
    return after("ulimit -f 8", arguments, folder_);  // 4 or 8 kB
  };
  const struct {
    const char* arguments;
    const char* file;
  } cases[] = {{"estimate a.mpack --estimator free_fall -o b.csv", "b.csv"},
               {"estimate a.mpack --estimator free_fall -o b.mpack", "b.mpack"},
               {"export a.mpack -o b.mcap", "b.mcap"},
               {"fit a.mpack -o b.npz --grid 40 40", "b.npz"}};
  for (const auto& [arguments, file] : cases) {
    const Ended ended = limited(arguments);
    EXPECT_EQ(ended.exit_code, 1) << arguments << ": " << ended.errors;
    EXPECT_THAT(ended.errors, HasSubstr(fmt::format("{}: cannot be written", file))) << arguments;
    EXPECT_FALSE(fs::exists(folder_ / file)) << arguments;
  }
}

TEST_F(Limits, AHangUpStopsARunUnlessItIsIgnored) {
  const std::string experiment = write_long_experiment(folder_);
  {
    StartedProgram program("run " + experiment + " --out a", folder_.path());
    while (program.is_running() && !fs::exists(folder_ / "a/state/key")) program.let_run(0.002);
    program.let_run(0.05);
    program.send(SIGHUP);
    const Ended ended = program.end();
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.errors, ContainsRegex("stopped; 0 of [0-9]+ recordings"));
  }
  const auto before = std::signal(SIGHUP, SIG_IGN);  // as nohup does; programs inherit it
  StartedProgram program("run " + experiment + " --out b", folder_.path());
  std::signal(SIGHUP, before);
  while (program.is_running() && !fs::exists(folder_ / "b/state/key")) program.let_run(0.002);
  program.send(SIGHUP);
  program.let_run(0.3);
  EXPECT_TRUE(program.is_running());
}

TEST_F(Limits, SpecialFilesAreRefusedAtOnce) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  fs::create_symlink("/dev/zero", folder_ / "zero");
  fs::create_symlink("pipe", folder_ / "to_pipe");
  fs::create_symlink("loop", folder_ / "loop");
  for (const std::string special : {"pipe", "zero", "to_pipe"}) {
    for (const std::string arguments :
         {"estimate {} --estimator free_fall", "estimate a.mpack --model {}",
          "estimate a.mpack --estimator free_fall --labels {}", "run {}", "simulate {} -o x.mpack",
          "fit {} -o x.npz", "export {} -o x.mcap", "render {} -o x.mp4"}) {
      EXPECT_THAT(refusal(fmt::format(fmt::runtime(arguments), special)),
                  HasSubstr(special + ": is not a regular file"))
          << arguments;
    }
  }
  for (const std::string robot : {"pipe", "zero", "a.mpack", "missing/robot", "./upkie"}) {
    for (const std::string arguments :
         {"check a.mpack", "estimate a.mpack", "fit a.mpack -o x.npz"}) {
      EXPECT_THAT(refusal(fmt::format("{} --robot {}", arguments, robot)),
                  HasSubstr(fmt::format("{}: expected a robot's file", robot)));
    }
  }
  EXPECT_THAT(refusal("check a.mpack --robot upkie"), HasSubstr("upkie: expected a robot's file"));
  EXPECT_THAT(refusal("estimate loop --estimator free_fall"),
              HasSubstr("loop: cannot be opened: "));
  EXPECT_THAT(refusal("run loop"), HasSubstr("loop: cannot be opened: "));
  EXPECT_THAT(refusal("estimate " + std::string(300, 'x') + " --estimator free_fall"),
              HasSubstr("xxx: cannot be opened: "));
}

TEST_F(Limits, LinksInPlaceOfARunsFoldersAreRefusedByName) {
  const std::string run = "run " + write_tiny_experiment(folder_) + " --no-pictures --out ";
  fs::create_directories(folder_ / "mine");
  for (const std::string name : {"tables", "recordings", "state", "models", "figures", "videos"}) {
    const fs::path out = folder_ / ("out_" + name);
    fs::create_directories(out);
    fs::create_directory_symlink(folder_ / "mine", out / name);
    EXPECT_THAT(refusal(run + out.string()), HasSubstr(name + ": is a link")) << name;
    EXPECT_TRUE(fs::is_empty(folder_ / "mine")) << name;
  }
  fs::create_directories(folder_ / "inner/state");
  fs::create_directory_symlink(folder_ / "mine", folder_ / "inner/state/evaluation");
  EXPECT_THAT(refusal(run + "inner"), HasSubstr("state/evaluation: is a link"));
  // A link that dangles, and one in a run of one's own.
  fs::create_directories(folder_ / "dangling");
  fs::create_directory_symlink("nowhere", folder_ / "dangling/figures");
  EXPECT_THAT(refusal(run + "dangling"), HasSubstr("figures: is a link"));
  EXPECT_EQ(touchdown_program(run + "own", folder_.path()).exit_code, 0);
  fs::rename(folder_ / "own/tables", folder_ / "moved");
  fs::create_directory_symlink(folder_ / "moved", folder_ / "own/tables");
  EXPECT_THAT(refusal(run + "own"), HasSubstr("tables: is a link"));
  EXPECT_THAT(refusal("report own"), HasSubstr("tables: is a link"));
  EXPECT_THAT(refusal("merge own"), HasSubstr("tables: is a link"));
}

TEST_F(Limits, NumbersThatWouldBecomeOthersAreRefused) {
  folder_.write("s.yaml", "# A scene.\nname: s\nend: {duration: 0.1}\n");
  for (const std::string number : {"-1", "18446744073709551616", "010", "1e3", "0x10", "", " 1"}) {
    EXPECT_THAT(refusal(fmt::format("simulate s.yaml -o x.mpack --seed='{}'", number)),
                HasSubstr("--seed"))
        << number;
  }
  EXPECT_EQ(
      touchdown_program("simulate s.yaml -o x.mpack --seed 18446744073709551615", folder_.path())
          .exit_code,
      0);
  for (const std::string number : {"nan", "inf", "-inf", "1e999", "07"}) {
    EXPECT_THAT(refusal(fmt::format(
                    "estimate a.mpack --estimator free_fall --figure x.png --from={}", number)),
                HasSubstr("--from"))
        << number;
  }
}

TEST_F(Limits, OutputsThatCannotBeWrittenAreRefusedBeforeAnythingIsComputed) {
  write_long_experiment(folder_);  // half an hour
  const std::string too_long(240, 'x');
  fs::create_symlink("loop", folder_ / "loop");
  for (const std::string& stem : {too_long, std::string("a.mpack/x"), std::string("/dev/full/x"),
                                  too_long + too_long, std::string("loop/x")}) {
    for (const auto& [arguments, extension] :
         {std::pair<std::string, std::string>{"simulate long.yaml -o ", ".mpack"},
          {"fit a.mpack -o ", ".npz"},
          {"estimate a.mpack -o ", ".csv"}}) {
      EXPECT_THAT(refusal(fmt::format("{}{}{}", arguments, stem, extension), 1),
                  HasSubstr("cannot be written"))
          << arguments << stem;
    }
  }
}

TEST_F(Limits, BytesOfValueZeroDoNotCutMessages) {
  folder_.write("nul.csv", std::string("start,end,contact\n0,1\0"
                                       "2,1\n",
                                       24));
  EXPECT_THAT(refusal("estimate a.mpack --labels nul.csv"), HasSubstr("found '1\u24002'"));
  folder_.write("wide.csv", std::string("s\0,\0", 4));
  EXPECT_THAT(refusal("estimate a.mpack --labels wide.csv"),
              AllOf(HasSubstr("s\u2400"), HasSubstr("expected start")));
}

// As of a script's variable that is not set: the default would be used instead.
TEST_F(Limits, EmptyTextsAreRefused) {
  for (const std::string arguments :
       {"estimate a.mpack --model ''", "estimate a.mpack --estimator ''", "estimate a.mpack -o ''",
        "estimate a.mpack --figure ''", "check a.mpack --robot ''", "estimate ''",
        "fit a.mpack -o m.npz --estimator ''", "fit a.mpack -o m.npz --robot ''",
        "simulate s.yaml -o x.mpack --sensors ''", "simulate s.yaml -o x.mpack --simulator ''",
        "run x.yaml --out ''"}) {
    EXPECT_THAT(refusal(arguments), HasSubstr("found an empty text")) << arguments;
  }
}

TEST_F(Limits, AbsurdTimesOfALogArePrintedShort) {
  for (const double time : {1e300, -1e22, 1e21}) {
    logs::Recording log = test::synthetic_log(2.0);
    log.observation[1000].time = time;
    logs::write_recording(log, folder_ / "t.mpack");
    for (const std::string verb : {"estimate", "check"}) {
      const Ended ended = touchdown_program(verb + " t.mpack", folder_.path());
      EXPECT_EQ(ended.exit_code, 0) << ended.errors;
      EXPECT_THAT(ended.output + ended.errors, Not(HasSubstr("0000000000")));
    }
  }
}

TEST_F(Limits, TextsOfFilesReachTheTerminalWithoutEscapes) {
  const std::string escape = "\x1b[31m";
  folder_.write("e.yaml", "# A scene.\nname: \"x\\e[31m\\nnext\"\n");
  EXPECT_THAT(refusal("simulate e.yaml -o x.mpack"), Not(HasSubstr(escape)));
  folder_.write("k.yaml", "# A scene.\nname: s\n\"k\\e[2J\": 1\n");
  EXPECT_THAT(refusal("simulate k.yaml -o x.mpack"),
              AllOf(Not(HasSubstr("\x1b")), HasSubstr("k\\x1b[2J")));
  folder_.write("l.csv", "start,end,cont" + escape + "act\n0,1,1\n");
  EXPECT_THAT(refusal("estimate a.mpack --estimator free_fall --labels l.csv"),
              AllOf(Not(HasSubstr(escape)), HasSubstr("cont\\x1b[31mact")));
  folder_.write("m.csv",
                "start,end,contact\n0,1,\xc2\x9b"
                "2J\n");
  EXPECT_THAT(refusal("estimate a.mpack --estimator free_fall --labels m.csv"),
              HasSubstr("\\u009b2J"));
  const std::string name = "no\x1b]0;t\x07\nne";
  EXPECT_THAT(refusal("estimate '" + name + "' --estimator free_fall"),
              HasSubstr("no\\x1b]0;t\\x07\\nne: no such file"));
  const Ended printed = touchdown_program(
      "estimate a.mpack --estimator free_fall -o '" + escape + ".csv'", folder_.path());
  EXPECT_EQ(printed.exit_code, 0) << printed.errors;
  EXPECT_THAT(printed.output, AllOf(Not(HasSubstr(escape)), HasSubstr("\\x1b[31m.csv")));
}

TEST_F(Limits, FiguresMayHaveNamesThatGnuplotTakesForSomethingElse) {
  for (const std::string name : {"-dash", "$run", "<ls", "@macro", "+", "a b", "'q'", "_u", "|x"}) {
    const Ended ended = touchdown_program(
        fmt::format("estimate a.mpack --estimator free_fall --figure=\"./{}.png\"",
                    name == "$run" ? "\\$run" : name),
        folder_.path());
    EXPECT_EQ(ended.exit_code, 0) << name << ": " << ended.errors;
    for (const char* const kind : {".png", ".svg", ".pdf", ".gp", ".dat"}) {
      EXPECT_TRUE(fs::is_regular_file(folder_ / (name + kind))) << name << kind;
    }
  }
}

/// What a program without enough descriptors or disk reports: one line, in which it names the
/// cause.
void expect_one_reason(const Ended& ended, const std::string& command) {
  EXPECT_TRUE(ended.exit_code == 0 || ended.exit_code == 1) << command << ": " << ended.errors;
  if (ended.exit_code == 0) return;
  const std::string line = last_line(ended.errors);
  EXPECT_THAT(line, StartsWith("touchdown: ")) << command;
  EXPECT_THAT(line, ::testing::AnyOf(HasSubstr("Too many open files"), HasSubstr("ulimit -n"),
                                     HasSubstr("descriptor")))
      << command;
}

TEST_F(Limits, TooFewDescriptorsAreNamedByEveryVerb) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "UndefinedBehaviorSanitizer opens a pipe to check the type of an object";
#endif
  folder_.write("s.yaml", "# A scene.\nname: s\nend: {duration: 0.1}\n");
  const std::string run = "run " + write_tiny_experiment(folder_) + " --out out";
  ASSERT_EQ(touchdown_program(run + " --no-pictures", folder_.path()).exit_code, 0);
  ASSERT_EQ(touchdown_program("simulate s.yaml -o s.mpack", folder_.path()).exit_code, 0);
  ASSERT_EQ(
      touchdown_program("fit a.mpack -o m.npz --estimator robust --grid 40 40", folder_.path())
          .exit_code,
      0);
  const std::vector<std::string> verbs = {"check a.mpack",
                                          "estimate a.mpack",
                                          "estimate a.mpack --model m.npz -o b.csv",
                                          "estimate a.mpack -o b.mpack",
                                          "estimate a.mpack --estimator free_fall --figure b.png",
                                          "export a.mpack -o b.mcap",
                                          "fit a.mpack -o n.npz --grid 40 40",
                                          "simulate s.yaml -o b.mpack",
                                          "list",
                                          "keys",
                                          "generate --count 1 -o generated",
                                          "render s.mpack -o b.mp4 --width 160 --height 120",
                                          "report out",
                                          "merge out --no-pictures",
                                          run + " --no-pictures",
                                          "clean ."};
  for (const std::string& arguments : verbs) {
    for (const int descriptors : {4, 5, 6, 7, 8, 10, 12, 16}) {
      fs::remove_all(folder_ / "generated");
      const Ended ended =
          after(fmt::format("exec 3>&- 4>&- 5>&- 6>&- 7>&- 8>&- 9>&-; ulimit -n {}", descriptors),
                arguments, folder_);  // without what a test runner leaves open
      expect_one_reason(ended, fmt::format("{} descriptors: {}", descriptors, arguments));
      if (ended.exit_code == 0) break;
    }
  }
  EXPECT_TRUE(fs::exists(folder_ / "out/tables/success.csv"));
}

TEST_F(Limits, AFullDiskIsNamedWithItsFileByEveryVerb) {
  const fs::path full = "/dev/full";
  if (!fs::exists(full)) GTEST_SKIP() << "/dev/full is missing";
  folder_.write("s.yaml", "# A scene.\nname: s\nend: {duration: 2}\n");
  ASSERT_EQ(touchdown_program("simulate s.yaml -o s.mpack", folder_.path()).exit_code, 0);
  const std::string run = "run " + write_tiny_experiment(folder_) + " --no-pictures --out out";
  // Blocks of 512 or 1024 bytes, by shell: all of these files are larger.
  const struct {
    std::string arguments;
    std::string file;
  } cases[] = {{"simulate s.yaml -o b.mpack", "b.mpack"},
               {"estimate a.mpack -o b.csv", "b.csv"},
               {"estimate a.mpack -o b.mpack", "b.mpack"},
               {"estimate a.mpack --estimator free_fall --figure b.png", "b.gp"},
               {"export a.mpack -o b.mcap", "b.mcap"},
               {"fit a.mpack -o b.npz --estimator robust", "b.npz"},
               {"render s.mpack -o b.mp4 --width 160 --height 120", "b.mp4"},
               {run, ""}};
  for (const auto& [arguments, file] : cases) {
    const Ended ended = after("ulimit -f 8", arguments, folder_);
    EXPECT_EQ(ended.exit_code, 1) << arguments << ": " << ended.errors;
    EXPECT_THAT(last_line(ended.errors),
                AllOf(StartsWith("touchdown: "), HasSubstr(file), HasSubstr("cannot be written")))
        << arguments;
    EXPECT_TRUE(file.empty() || !fs::exists(folder_ / file)) << arguments;
  }
  for (const std::string arguments :
       {"estimate a.mpack --estimator free_fall -o -", "estimate a.mpack", "check a.mpack", "list",
        "keys", "fit a.mpack -o c.npz --estimator robust --grid 40 40"}) {
    const std::string command = fmt::format("cd '{}' && '{}' {} >/dev/full 2>.stderr",
                                            folder_.path().string(), TOUCHDOWN_PROGRAM, arguments);
    const int status = std::system(command.c_str());
    EXPECT_EQ(WEXITSTATUS(status), 1) << arguments;
    EXPECT_THAT(last_line(read_file(folder_ / ".stderr")), HasSubstr("standard output"))
        << arguments;
  }
}

}  // namespace
}  // namespace touchdown::cli
