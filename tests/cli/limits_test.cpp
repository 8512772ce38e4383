// Limits and signals of the system, special files, texts and numbers without meaning.

#include <csignal>
#include <map>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "logs/log/recording_file.hpp"
#include "program.hpp"
#include "synthetic_log.hpp"
#include "tests/draws.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

namespace fs = std::filesystem;

std::string last_line(std::string text) {
  while (text.ends_with('\n')) text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

/// A folder with a log, `a.mpack`.
class Limits : public InFolder {
 protected:
  Limits() { logs::write_recording(test::synthetic_log(2.0), folder_ / "a.mpack"); }
};

TEST_F(Limits, AHangUpStopsARunUnlessItIsIgnored) {
  const std::string experiment = write_long_experiment(folder_);
  {
    StartedProgram program("run " + experiment + " --out a", folder_.path());
    program.let_run_until([&] { return folder_.has("a/state/key"); });
    program.let_run(0.05);
    program.send(SIGHUP);
    const Ended ended = program.end();
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.errors, ContainsRegex("stopped; 0 of [0-9]+ recordings"));
  }
  const auto before = std::signal(SIGHUP, SIG_IGN);  // as nohup does; programs inherit it
  StartedProgram program("run " + experiment + " --out b", folder_.path());
  std::signal(SIGHUP, before);
  program.let_run_until([&] { return folder_.has("b/state/key"); });
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
          "fit {} -o x.npz", "convert {} -o x.mcap", "render {} -o x.mp4"}) {
      folder_.expect_refusals(
          {{fmt::format(fmt::runtime(arguments), special), {special + ": is not a regular file"}}});
    }
  }
  for (const std::string robot : {"pipe", "zero", "a.mpack", "missing/robot", "./upkie"}) {
    for (const std::string arguments :
         {"check a.mpack", "estimate a.mpack", "fit a.mpack -o x.npz"}) {
      folder_.expect_refusals({{fmt::format("{} --robot {}", arguments, robot),
                                {robot + ": expected a robot's file"}}});
    }
  }
  folder_.expect_refusals({{"check a.mpack --robot upkie", {"upkie: expected a robot's file"}},
                           {"estimate loop --estimator free_fall", {"loop: cannot be opened: "}},
                           {"run loop", {"loop: cannot be opened: "}},
                           {"estimate " + std::string(300, 'x') + " --estimator free_fall",
                            {"xxx: cannot be opened: "}}});
}

TEST_F(Limits, LinksInPlaceOfARunsFoldersAreRefusedByName) {
  const std::string run = "run " + write_tiny_experiment(folder_) + " --no-pictures --out ";
  fs::create_directories(folder_ / "mine");
  for (const std::string name : {"tables", "recordings", "state", "models", "figures", "videos"}) {
    fs::create_directories(folder_ / ("out_" + name));
    fs::create_directory_symlink(folder_ / "mine", folder_ / ("out_" + name + "/" + name));
    folder_.expect_refusals({{run + "out_" + name, {name + ": is a link"}}});
  }
  fs::create_directories(folder_ / "inner/state");
  fs::create_directory_symlink(folder_ / "mine", folder_ / "inner/state/evaluation");
  fs::create_directories(folder_ / "dangling");
  fs::create_directory_symlink("nowhere", folder_ / "dangling/figures");
  folder_.output_of(run + "own");
  fs::rename(folder_ / "own/tables", folder_ / "moved");
  fs::create_directory_symlink(folder_ / "moved", folder_ / "own/tables");
  folder_.expect_refusals({{run + "inner", {"state/evaluation: is a link"}},
                           {run + "dangling", {"figures: is a link"}},
                           {run + "own", {"tables: is a link"}},
                           {"report own", {"tables: is a link"}},
                           {"run own", {"tables: is a link"}}});
  EXPECT_TRUE(fs::is_empty(folder_ / "mine"));
}

TEST_F(Limits, NumbersThatWouldBecomeOthersAreRefused) {
  folder_.write("s.yaml", "# A scene.\nname: s\nend: {duration: 0.1}\n");
  for (const std::string number : {"-1", "18446744073709551616", "010", "1e3", "0x10", "", " 1"}) {
    folder_.expect_refusals(
        {{fmt::format("simulate s.yaml -o x.mpack --seed='{}'", number), {"--seed"}}});
  }
  folder_.output_of("simulate s.yaml -o x.mpack --seed 18446744073709551615");
  for (const std::string number : {"nan", "inf", "-inf", "1e999", "07"}) {
    folder_.expect_refusals(
        {{"estimate a.mpack --estimator free_fall --figure x.png --from=" + number, {"--from"}}});
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
      folder_.expect_refusals(
          {{fmt::format("{}{}{}", arguments, stem, extension), {"cannot be written"}}}, 1);
    }
  }
}

// As of a script's variable that is not set: the default would be used instead.
TEST_F(Limits, EmptyTextsAreRefused) {
  for (const std::string arguments :
       {"estimate a.mpack --model ''", "estimate a.mpack --estimator ''", "estimate a.mpack -o ''",
        "estimate a.mpack --figure ''", "check a.mpack --robot ''", "estimate ''",
        "fit a.mpack -o m.npz --estimator ''", "fit a.mpack -o m.npz --robot ''",
        "simulate s.yaml -o x.mpack --sensors ''", "simulate s.yaml -o x.mpack --simulator ''",
        "run x.yaml --out ''", "run x.yaml --out a --shard ''"}) {
    folder_.expect_refusals({{arguments, {"found an empty text"}}});
  }
}

TEST_F(Limits, AbsurdTimesOfALogArePrintedShort) {
  for (const double time : {1e300, -1e22, 1e21}) {
    logs::Recording log = test::synthetic_log(2.0);
    log.observation[1000].time = time;
    logs::write_recording(log, folder_ / "t.mpack");
    for (const std::string verb : {"estimate", "check"}) {
      const Ended ended = folder_.run(verb + " t.mpack");
      EXPECT_EQ(ended.exit_code, 0) << ended.errors;
      EXPECT_THAT(ended.output + ended.errors, Not(HasSubstr("0000000000")));
    }
  }
}

TEST_F(Limits, TextsOfFilesReachTheTerminalWithoutEscapes) {
  const std::string escape = "\x1b[31m";
  const std::string estimate = "estimate a.mpack --estimator free_fall ";
  folder_.write("k.yaml", "# A scene.\nname: s\n\"k\\e[2J\": 1\n");
  folder_.write("l.csv", "start,end,cont" + escape + "act\n0,1,1\n");
  folder_.write("m.csv",
                "start,end,contact\n0,1,\xc2\x9b"
                "2J\n");
  folder_.write("nul.csv", std::string("start,end,contact\n0,1\0"
                                       "2,1\n",
                                       24));
  folder_.write("wide.csv", std::string("s\0,\0", 4));
  folder_.write("name.csv", std::string("st\0art,end\n", 11));
  folder_.expect_refusals(
      {{"simulate k.yaml -o x.mpack", {"k\\x1b[2J"}},
       {estimate + "--labels l.csv", {"cont\\x1b[31mact"}},
       {estimate + "--labels m.csv", {"\\u009b2J"}},
       {estimate + "--labels nul.csv", {"found '1\u24002'"}},  // not cut at a byte of value 0
       {estimate + "--labels name.csv", {"st\u2400art", "expected start"}},
       {estimate + "--labels wide.csv", {"wide.csv: is UTF-16"}},
       {"estimate 'no\x1b]0;t\x07\nne' --estimator free_fall",
        {"no\\x1b]0;t\\x07\\nne: no such file"}}});
  folder_.write("e.yaml", "# A scene.\nname: \"x\\e[31m\\nnext\"\n");
  EXPECT_THAT(folder_.refusal_of("simulate e.yaml -o x.mpack"), Not(HasSubstr(escape)));
  EXPECT_THAT(folder_.output_of(estimate + "-o '" + escape + ".csv'"),
              AllOf(Not(HasSubstr(escape)), HasSubstr("\\x1b[31m.csv")));
}

TEST_F(Limits, FiguresMayHaveNamesThatGnuplotTakesForSomethingElse) {
  std::vector<std::string> names = {"-dash", "$run", "a b", "|x"};
  if (draws_all()) names.insert(names.end(), {"<ls", "@macro", "+", "'q'", "_u"});
  for (const std::string& name : names) {
    folder_.output_of(fmt::format("estimate a.mpack --estimator free_fall --figure=\"./{}.png\"",
                                  name == "$run" ? "\\$run" : name));
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
  ASSERT_EQ(folder_.execute(run + " --no-pictures").exit_code, 0);
  folder_.output_of("simulate s.yaml -o s.mpack");
  folder_.output_of("fit a.mpack -o m.npz --estimator robust --grid 40 40");
  const std::vector<std::string> verbs = {"check a.mpack",
                                          "estimate a.mpack",
                                          "estimate a.mpack --model m.npz -o b.csv",
                                          "estimate a.mpack -o b.mpack",
                                          "estimate a.mpack --estimator free_fall --figure b.png",
                                          "convert a.mpack -o b.mcap",
                                          "fit a.mpack -o n.npz --grid 40 40",
                                          "simulate s.yaml -o b.mpack",
                                          "list",
                                          "list keys",
                                          "generate --count 1 -o generated",
                                          "render s.mpack -o b.mp4 --width 160 --height 120",
                                          "report out",
                                          "run out --no-pictures",
                                          run + " --no-pictures"};
  for (const std::string& arguments : verbs) {
    for (const int descriptors :
         draws_all() ? std::vector{4, 5, 6, 7, 8, 10, 12, 16} : std::vector{5, 8, 12}) {
      fs::remove_all(folder_ / "generated");
      const Ended ended = folder_.execute(  // without what a test runner leaves open
          arguments,
          fmt::format("exec 3>&- 4>&- 5>&- 6>&- 7>&- 8>&- 9>&-; ulimit -n {} &&", descriptors));
      expect_one_reason(ended, fmt::format("{} descriptors: {}", descriptors, arguments));
      if (ended.exit_code == 0) break;
    }
  }
  EXPECT_TRUE(folder_.has("out/tables/success.csv"));
}

TEST_F(Limits, TooLittleMemoryToStartIsNamed) {
  for (const int kilobytes : {100'000, 150'000, 250'000, 300'000}) {
    const Ended ended = folder_.execute("list", fmt::format("ulimit -v {} &&", kilobytes));
    EXPECT_GT(ended.exit_code, 0) << kilobytes;
    EXPECT_THAT(ended.errors,
                AnyOf(HasSubstr("`ulimit -v` must allow 1 GB"),
                      HasSubstr("error while loading shared libraries"), HasSubstr("Sanitizer")))
        << kilobytes;
  }
}

TEST_F(Limits, AFullDiskIsNamedWithItsFileByEveryVerb) {
  const fs::path full = "/dev/full";
  if (!fs::exists(full)) GTEST_SKIP() << "/dev/full is missing";
  folder_.write("s.yaml", "# A scene.\nname: s\nend: {duration: 2}\n");
  folder_.output_of("simulate s.yaml -o s.mpack");
  const std::string run = "run " + write_tiny_experiment(folder_) + " --no-pictures --out out";
  // Blocks of 512 or 1024 bytes, by shell: all of these files are larger.
  const struct {
    std::string arguments;
    std::string file;
  } cases[] = {{"simulate s.yaml -o b.mpack", "b.mpack"},
               {"estimate a.mpack -o b.csv", "b.csv"},
               {"estimate a.mpack -o b.mpack", "b.mpack"},
               {"estimate a.mpack --estimator free_fall --figure b.png", "b.gp"},
               {"convert a.mpack -o b.mcap", "b.mcap"},
               {"fit a.mpack -o b.npz --estimator robust", "b.npz"},
               {"render s.mpack -o b.mp4 --width 160 --height 120", "b.mp4"},
               {run, ""}};
  for (const auto& [arguments, file] : cases) {
    const Ended ended = folder_.execute(arguments, "ulimit -f 8 &&");
    EXPECT_EQ(ended.exit_code, 1) << arguments << ": " << ended.errors;
    EXPECT_THAT(last_line(ended.errors),
                AllOf(StartsWith("touchdown: "), HasSubstr(file), HasSubstr("cannot be written")))
        << arguments;
    EXPECT_TRUE(file.empty() || !folder_.has(file)) << arguments;
  }
  for (const std::string arguments :
       {"estimate a.mpack --estimator free_fall -o -", "estimate a.mpack", "check a.mpack", "list",
        "list keys", "fit a.mpack -o c.npz --estimator robust --grid 40 40"}) {
    const Ended ended = folder_.run(arguments + " >/dev/full");
    EXPECT_EQ(ended.exit_code, 1) << arguments;
    EXPECT_THAT(last_line(ended.errors), HasSubstr("standard output")) << arguments;
  }
}

using StandardError = InFolder;
using StandardOutput = InFolder;
using TextThatIsNotUtf8 = InFolder;

TEST_F(StandardError, ThatIsFullOrClosedDoesNotStopARunOrChangeItsExitCode) {
  const std::string run = "run " + write_tiny_experiment(folder_) + " --no-pictures --out ";
  folder_.output_of(run + "plain");
  for (const std::string stream : {"2>/dev/full", "2>&-"}) {
    fs::remove_all(folder_ / "other");
    EXPECT_EQ(folder_.run(run + "other " + stream).exit_code, 0) << stream;
    EXPECT_EQ(folder_.text("other/tables/views.csv"), folder_.text("plain/tables/views.csv"));
  }
  for (const std::string stream : {"2>/dev/full", "2>&-", "<&- >&- 2>&-"}) {
    EXPECT_EQ(folder_.run("fit missing.mpack -o m.npz " + stream).exit_code, 2) << stream;
  }
}

TEST_F(StandardError, ThatIsClosedDoesNotEndUpInAFile) {
  logs::write_recording(test::synthetic_log(1.0), folder_ / "a.mpack");
  const std::string bytes = folder_.text("a.mpack");
  folder_.write("cut.mpack", bytes.substr(0, bytes.size() - 5));  // which causes a warning
  const std::string estimate = "estimate cut.mpack --estimator free_fall -o ";
  EXPECT_THAT(folder_.messages_of(estimate + "plain.csv"), HasSubstr("cut off"));
  folder_.output_of(estimate + "b.csv <&- 2>&-");
  EXPECT_EQ(folder_.text("b.csv"), folder_.text("plain.csv"));
}

TEST_F(StandardOutput, ThatIsFullOrClosedIsAnError) {
  for (const auto& [stream, reason] : std::map<std::string, std::string>{
           {">/dev/full", "No space left on device"}, {">&-", "Bad file descriptor"}}) {
    for (const std::string command :
         {"list", "list keys", "list commands --markdown", "--help", "run --help", "--version"}) {
      EXPECT_EQ(folder_.refusal_of(fmt::format("{} {}", command, stream), 1),
                "touchdown: standard output cannot be written: " + reason + "\n")
          << command << stream;
    }
    folder_.expect_refusals({{"listt " + stream, {"did you mean 'list'?"}}});
  }
  EXPECT_THAT(folder_.messages_of("list"), IsEmpty());
}

TEST_F(StandardOutput, ThatIsFullStopsALiveTableButNotTheReport) {
  const Ended run = folder_.run("run " + write_tiny_experiment(folder_) + " --out out >/dev/full");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.errors, HasSubstr("standard output cannot be written: No space left on device"));
  EXPECT_TRUE(folder_.has("out/report.html"));
  logs::write_recording(test::synthetic_log(2.0), folder_ / "a.mpack");
  const Ended live = folder_.run("estimate - --estimator free_fall <a.mpack >/dev/full");
  EXPECT_EQ(live.exit_code, 1);
  EXPECT_THAT(live.errors, HasSubstr("cannot be written"));
}

TEST_F(TextThatIsNotUtf8, IsRefusedInAFileAndReadableInTheManifest) {
  const std::string experiment = write_tiny_experiment(folder_);
  folder_.write("bad.yaml", fmt::format("# caf\xc3\xa9\n{}# \xe9\n", folder_.text(experiment)));
  folder_.expect_refusals({{"run bad.yaml --out out", {"bad.yaml:13:3: not UTF-8: byte 0xe9"}}});
  EXPECT_FALSE(folder_.has("out"));
  folder_.output_of("run " + experiment + " --no-pictures --out 'o\xff'");
  const auto manifest = nlohmann::json::parse(folder_.text("o\xff/manifest.json"));
  EXPECT_THAT(manifest["command"].get<std::string>(), HasSubstr("--out o?"));

  folder_.write("r\xe9.xml", read_file(fs::path(TOUCHDOWN_SOURCE_DIR) / "models/upkie.xml"));
  const auto check = nlohmann::json::parse(folder_.output_of("check 'r\xe9.xml' --json"));
  EXPECT_EQ(check["file"].get<std::string>(), "r\xef\xbf\xbd.xml");  // the replacement character
}

}  // namespace
}  // namespace touchdown::cli
