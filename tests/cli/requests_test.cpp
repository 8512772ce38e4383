#include <algorithm>
#include <cctype>
#include <functional>
#include <map>
#include <regex>
#include <set>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/table.hpp"
#include "logs/log/recording_file.hpp"
#include "program.hpp"
#include "synthetic_log.hpp"

namespace touchdown::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

namespace fs = std::filesystem;

/// All matches of a group in a text.
std::vector<std::string> found_in(const std::string& text, const char* pattern) {
  const std::regex shape(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), shape), end; match != end; ++match) {
    found.push_back(match->str(1));
  }
  return found;
}

using WrongRequest = InFolder;

TEST_F(WrongRequest, IsOneLineWithThePlaceAndTheNearestName) {
  write_tiny_experiment(folder_);
  folder_.write("x.mpack", "no log");
  folder_.write("broken.yaml", "name: [tiny\n");
  folder_.expect_refusals(
      {{"rnu x.yaml", {"unknown command 'rnu'", "did you mean 'run'?"}},
       {"run", {"experiment"}},
       {"run experiments/stiars.yaml",
        {"experiments/stiars.yaml: no such file", "did you mean 'experiments/stairs.yaml'?"}},
       {"run experiments/stairs.yml", {"did you mean 'experiments/stairs.yaml'?"}},
       {"simulate scenarios/kerb.ymal -o new.mpack", {"did you mean 'scenarios/kerb.yaml'?"}},
       {"check models/upkie.xml --figure new.txt", {"new.txt", ".png"}},
       {"check models/upkie_heavy.yaml --figure new", {"new", ".png"}},
       {"run tiny.yaml --set noise.sedes=3", {"did you mean 'seeds'?"}},
       {"run tiny.yaml --set noise", {"key=value"}},
       {"run broken.yaml", {"not valid YAML"}},
       {"run experiments/nmn.yaml",
        {"experiments/nmn.yaml: is a training file; try: touchdown train "}},
       {"run scenarios/stairs.yaml",
        {"scenarios/stairs.yaml: is a scenario; try: touchdown simulate "}},
       {"simulate experiments/stairs.yaml -o new.mpack",
        {"experiments/stairs.yaml: is an experiment; try: touchdown run "}},
       {"simulate step.yaml --simulator bulet -o new.mpack", {"bullet"}},
       {"render x.mpack -o new.mp4", {"x.mpack"}},
       {"render missing.mpack -o new.mp4", {"missing.mpack"}},
       {"render scenarios/stairs.yaml -o new.mp4", {"no such file"}},
       {"render step.yaml -o new.mp4", {"`touchdown simulate` makes such a log of a scenario"}}});
  EXPECT_FALSE(folder_.has("new.mpack"));
  EXPECT_FALSE(folder_.has("new.mp4"));
}

/// A place in a file is enough; without one, several options may have named the file.
TEST_F(WrongRequest, AboutAFileNamesItsOptionOrThePlaceInIt) {
  logs::write_recording(test::synthetic_log(3.0), folder_ / "log.mpack");
  folder_.write("bad.npz", "bad");
  folder_.write("bad.csv", "bad\n");
  folder_.write("bad.yaml", "a: [\n");
  const std::string simulate = "simulate scenarios/hop.yaml -o x.mpack ";
  const std::string estimate = "estimate log.mpack ";
  folder_.expect_refusals(
      {{estimate + "--model bad.npz", {"touchdown: --model: bad.npz: "}},
       {estimate + "--model none.npz", {"touchdown: --model: none.npz: no such"}},
       {estimate + "--mapping none.yaml", {"touchdown: --mapping: none.yaml: "}},
       {estimate + "--mapping bad.yaml", {"touchdown: bad.yaml:2:1: "}},
       {estimate + "--robot none.xml", {"touchdown: --robot: none.xml: no such"}}});
  folder_.expect_refusals({
      {"fit log.mpack -o x.npz --labels none.csv", {"touchdown: --labels: none.csv: no such file"}},
      {"fit log.mpack -o x.npz --labels bad.csv", {"touchdown: bad.csv:1:1: "}},
      {"fit log.mpack -o x.npz --contact none.mpack",
       {"touchdown: --contact: none.mpack: no such"}},
      {"fit none.mpack -o x.npz", {"touchdown: none.mpack: no such file"}},
      {"fit log.mpack -o log.mpack", {"touchdown: log.mpack: is the log itself"}},
      {"check log.mpack --mapping none.yaml", {"touchdown: --mapping: none.yaml: no such file"}},
      {"convert none.npz -o x.hpp", {"touchdown: none.npz: no such file"}},
      {"convert log.mpack -o x.mcap --robot none.xml", {"touchdown: --robot: none.xml: no such"}},
      {simulate + "--sensors none.yaml", {"touchdown: --sensors: none.yaml: no such file"}},
      {simulate + "--sensors bad.yaml", {"touchdown: bad.yaml:2:1: "}},
  });
}

TEST_F(WrongRequest, NamesWhatAFileIsAndWhatAKeyTakes) {
  write_tiny_experiment(folder_);
  folder_.output_of("simulate step.yaml -o run.mpack");
  const std::string upkie = read_file(fs::path(TOUCHDOWN_SOURCE_DIR) / "models/upkie.xml");
  folder_.write("mine.xml", std::regex_replace(upkie, std::regex("\"imu\""), "\"chip\""));
  folder_.write("robot.yaml", "mjcf: mine.xml\n");
  folder_.write("old.yaml", "urdf: mine.urdf\n");
  folder_.write("map.yaml", "sources: {joints: /joint_states, imu: /imu}\njoints: {}\n");
  folder_.write("log.csv", "a,b\n1,2\n");
  folder_.write("notes.md", "# Notes\n");
  fs::create_directory(folder_ / "two");
  folder_.write("two/a.db3", "");
  folder_.write("two/b.mcap", "");
  folder_.write("gap.yaml", "name: g\nterrain:\n  pieces:\n    - gap: {length: 1}\n");
  folder_.write("tab.yaml", "name: g\nterrain:\n\tfriction: 1\n");
  folder_.write("tabs.yaml", "name: g\nterrain: {}\n \tend: 1\n");
  folder_.write("merge.yaml", "<<: {name: x}\nseed: 1\n");
  folder_.write("null.yaml", "name: null\n");
  folder_.write("none.yaml", "seed: 1\nname:\n");
  const std::string simulate = "simulate scenarios/flat.yaml -o x.mpack --set ";
  folder_.expect_refusals({
      {"run run.mpack", {"run.mpack: is a recording, which `touchdown estimate` and", "YAML"}},
      {"estimate run.mpack --mapping log.csv", {"log.csv: is a table or arrays: expected a YAML"}},
      {"run mine.xml", {"mine.xml: is a robot, which `touchdown check` takes"}},
      {"run robot.yaml", {"is a robot's file; try: touchdown check robot.yaml"}},
      {"run map.yaml", {"is a mapping file; try: touchdown check LOG --mapping map.yaml"}},
      {"check tiny.yaml", {"is an experiment; try: touchdown run "}},
      {"check step.yaml", {"is a scenario; try: touchdown simulate "}},
      {"estimate run.mpack --robot scenarios/stairs.yaml", {"is a scenario; try: "}},
      {"check notes.md", {"notes.md: byte 0: expected a MessagePack map", "no log in Upkie's"}},
      {"estimate log.csv --mapping robot.yaml", {"robot.yaml: is a robot's file, which --robot"}},
      {"convert log.csv --mapping robot.yaml -o x.mpack", {"is a robot's file, which --robot"}},
      {"convert run.mpack -o x.bag", {"x.bag: expected FILE.mcap"}},
      {"convert run.mpack -o x.mcap --dry-run", {"--dry-run: expected --benchmark DIR"}},
      {"convert run.mpack -o x.npz", {"x.npz: expected FILE.mcap"}},
      {"report none --figure x", {"none: no run directory of an experiment"}},
      {"report none --width 88mm", {"none: no run directory of an experiment"}},
      {simulate + "robot=old.yaml", {"old.yaml:1:7: urdf: ", "mjcf: FILE.urdf"}},
      {"run tiny.yaml --dry-run --set hyperparameters.robust.threshold=2",
       {"hyperparameters.robust: threshold: expected 0 to 1, found 2"}},
      {"render run.mpack --poster -o x.png --from 100", {"a picture from 100 s on: expected a "}},
      {"render run.mpack --scene -o x.png --from -3", {"a picture from -3 s on: expected a time"}},
      {"render run.mpack -o x.mp4 --from 9 --to 3", {"from 9 s to 3 s: it ends before it begins"}},
      {"render run.mpack -o x.mp4 --from 100", {"from 100 s on: expected a time from 0 to 2.5"}},
      {simulate + "robot.mass=2", {"--set robot.mass=2: robot: expected a text, found keys: "}},
      {simulate + "velocity=0.4", {"expected a list of items with the keys time, velocity"}},
      {simulate + "forces=3", {"--set forces=3: forces: expected a list of items with the keys "}},
      {simulate + "robot=mine.xml", {"expected a site named 'imu'", "--write robot.yaml"}},
      {"simulate gap.yaml -o x.mpack",
       {"gap.yaml:4:7: ", "gap: unknown key (did you mean 'ramp'?) (known: ", "stairs"}},
      {"check two --mapping map.yaml", {"two: a.db3 and b.mcap have two formats"}},
      {"simulate tab.yaml -o x.mpack", {"tab.yaml:3:1: not valid YAML: a tab indents the line"}},
      {"simulate tabs.yaml -o x.mpack", {"tabs.yaml:3:2: not valid YAML: a tab indents the line"}},
      {"simulate merge.yaml -o x.mpack", {"merge.yaml:1:1: <<: merged keys are not read"}},
      {"simulate null.yaml -o x.mpack", {"null.yaml:1:7: name: expected a value, found none"}},
      {"run none.yaml", {"none.yaml:3:1: name: expected a value, found none"}},
  });
}

TEST_F(WrongRequest, SetsAKeyOnce) {
  const std::string run = "run " + write_tiny_experiment(folder_) + " --dry-run";
  const std::string simulate = "simulate scenarios/flat.yaml -o x.mpack";
  folder_.expect_refusals(
      {{run + " --set seed=1 --set seed=2", {"--set seed=2: would replace --set seed=1"}},
       {run + " --set seed=1 --set seed=1", {"--set seed=1: would replace --set seed=1"}},
       {run + " --set noise.seeds=2 --set noise={}",
        {"--set noise={}: would replace --set noise.seeds=2"}},
       {simulate + " --set end.duration=1 --set terrain={} --set end.duration=2",
        {"--set end.duration=2: would replace --set end.duration=1"}},
       {"fit a.mpack -o m.npz --set leave_below=0.1 --set leave_below=0.2",
        {"'leave_below' is set twice"}}});
}

TEST_F(WrongRequest, NamesAnOptionThatIsForAnotherConversion) {
  folder_.write("map.yaml", "joints: {}\n");
  folder_.write("log.csv", "a,b\n1,2\n");
  const std::vector<std::string> options = {
      "--labels x.csv", "--strict",      "--sensors ideal", "--simulator bullet",     "--dry-run",
      "--rate 500",     "--robot upkie", "--set lead=1",    "--estimator load_filter"};
  const std::vector<std::pair<std::string, std::set<std::string>>> conversions = {
      {"log.csv --mapping map.yaml -o x.mpack", {"--labels", "--strict"}},
      {"log.mpack -o x.mcap", {"--robot"}},
      {"model.npz -o x.hpp", {"--rate", "--robot", "--set", "--estimator"}},
      {"mine.xml -o x.npz", {"--set"}},
      {"--benchmark b none", {"--sensors", "--simulator", "--dry-run", "--robot"}}};
  for (const auto& [conversion, fitting] : conversions) {
    for (const std::string& option : options) {
      const std::string name = option.substr(0, option.find(' '));
      const std::string command = "convert " + conversion + " " + option;
      const auto refused = HasSubstr("touchdown: " + name + ": expected ");
      if (fitting.contains(name)) {
        EXPECT_THAT(folder_.refusal_of(command), ::testing::Not(refused)) << command;
      } else {
        EXPECT_THAT(folder_.refusal_of(command), refused) << command;
      }
    }
  }
}

using Help = InFolder;

TEST_F(Help, BeginsWithAnExample) {
  for (const std::string verb : {"", "run", "simulate", "render", "fit", "estimate"}) {
    EXPECT_THAT(folder_.output_of(verb + " --help"),
                StartsWith("touchdown " + (verb.empty() ? "run" : verb) + " "));
  }
}

TEST_F(Help, ListsExperimentsScenariosEnginesAndEstimatorsInOneShortSentenceEach) {
  constexpr std::size_t longest = 95;
  const std::string listed = folder_.output_of("list");
  for (const char* name :
       {"experiments/stairs.yaml", "scenarios/stairs.yaml", "mujoco", "bullet", "robust",
        "always_contact", "noise/profiles/upkie.yaml   Upkie: servos by moteus",
        "noise/profiles/harsh.yaml"}) {
    EXPECT_THAT(listed, HasSubstr(name));
  }
  const std::vector<std::string> sentences = found_in(listed, "\n  \\S+\\.yaml +([^\n]*)");
  EXPECT_GE(sentences.size(), 50U);
  for (const std::string& sentence : sentences) {
    EXPECT_THAT(sentence, ::testing::EndsWith("."));
    EXPECT_LE(width(sentence), longest) << sentence;
  }
}

struct VerbFlags {
  std::string verb;  ///< empty for the program itself
  std::vector<std::string> long_flags;
};

class UnknownFlag : public InFolder {
 protected:
  /// Every verb that is built, with the long flags that its help lists.
  std::vector<VerbFlags> all_flags() const {
    std::vector<std::string> verbs =
        found_in(folder_.output_of("--help"), "\n  ([a-z]+)  +touchdown ");
    verbs.insert(verbs.begin(), "");
    std::vector<VerbFlags> all;
    for (const std::string& verb : verbs) {
      const Ended help = folder_.run(verb + " --help");
      if (help.exit_code != 0) continue;  // `train` and `watch` are programs of their own
      const std::string options = help.output.substr(help.output.find("Options:"));
      all.push_back({verb, found_in(options, "\n  (?:-[a-z],)?(--[a-z-]+)")});
    }
    return all;
  }
};

struct Typo {
  const char* kind;
  std::function<std::string(const std::string& flag)> of;
};

const std::vector<Typo>& typos() {
  static const std::vector<Typo> all = {
      {"plural", [](const std::string& flag) { return flag + "s"; }},
      {"letter missing", [](std::string flag) { return flag.erase(4, 1); }},
      {"letter twice", [](std::string flag) { return flag.insert(3, 1, flag[3]); }},
      {"last letter missing",
       [](const std::string& flag) { return flag.substr(0, flag.size() - 1); }},
      {"letters swapped",
       [](std::string flag) {
         std::swap(flag[3], flag[4]);
         return flag;
       }},
      {"one dash too few", [](const std::string& flag) { return flag.substr(1); }},
      {"with a value", [](const std::string& flag) { return flag + "x=3"; }},
      {"in capitals",
       [](std::string flag) {
         for (char& letter : flag) letter = static_cast<char>(std::toupper(letter));
         return flag;
       }},
      {"underscores",
       [](const std::string& flag) {
         return "--" + std::regex_replace(flag.substr(2), std::regex("-"), "_") + "_";
       }},
      {"with its value behind it", [](const std::string& flag) { return flag + "12345"; }},
      {"its beginning", [](const std::string& flag) { return flag.substr(0, flag.size() - 3); }},
  };
  return all;
}

/// The first letter of "-output" is a flag of one letter for verbs that have "-o".
bool is_other_flag(const std::string& typo, const VerbFlags& of) {
  const bool is_short = typo.size() > 1 && typo[1] != '-';
  if (is_short && (typo[1] == 'o' || typo[1] == 'h')) return true;
  const std::string name = typo.substr(0, typo.find('='));
  return std::count(of.long_flags.begin(), of.long_flags.end(), name) > 0;
}

/// Other flags of the verb of which the typo could be one as well.
bool is_ambiguous(const std::string& typo, const std::string& flag, const VerbFlags& of) {
  const std::string beginning = typo.substr(0, 5);
  return std::any_of(of.long_flags.begin(), of.long_flags.end(), [&](const std::string& other) {
    return other != flag && (other.starts_with(beginning) || other.starts_with(flag.substr(0, 5)));
  });
}

// Each flag with the next kind of typo, so that each kind meets many flags.
TEST_F(UnknownFlag, OfAnyCommandNamesTheFlagThatWasMeant) {
  std::size_t next = 0;
  int tried = 0;
  std::set<std::string> kinds;
  for (const VerbFlags& verb : all_flags()) {
    for (const std::string& flag : verb.long_flags) {
      if (flag.size() < 6) continue;  // a typo of "--to" is near to anything
      const Typo& typo = typos().at(next++ % typos().size());
      const std::string word = typo.of(flag);
      if (is_other_flag(word, verb) || is_ambiguous(word, flag, verb)) continue;
      SCOPED_TRACE(typo.kind);
      folder_.expect_refusals({{fmt::format("{} {}", verb.verb, word),
                                {fmt::format("unknown flag '{}' (did you mean '{}'?)",
                                             word.substr(0, word.find('=')), flag)}}});
      kinds.insert(typo.kind);
      ++tried;
    }
    // One that is near no flag lists all of them.
    folder_.expect_refusals({{verb.verb + " --qqqqqqqqqqqqqqqqqqqq x", verb.long_flags}});
  }
  EXPECT_GE(tried, 80);
  EXPECT_EQ(kinds.size(), typos().size());
}

TEST_F(UnknownFlag, OfOneLetterOrOfAFileShowsWhatWasMeant) {
  folder_.expect_refusals(
      {{"-v", {"did you mean '--version'?"}},
       {"estimate -e x log", {"did you mean '--estimator'?"}},
       {"list scenaros", {"unknown kind of file 'scenaros' (did you mean 'scenario'?)"}},
       {"compare a b --metric acuracy",
        {"--metric: 'acuracy': expected accuracy or balanced_accuracy (did you "
         "mean 'accuracy'?)"}},
       {"render log -o a.mp4 --quality pgae", {"did you mean 'page'?"}},
       {"fit -z", {"known: "}}});
  for (const std::string name : {"-run.mpack", "--out", "-r"}) {
    folder_.write(name, "");
    folder_.expect_refusals(
        {{"check " + name, {fmt::format("unknown flag '{0}': write ./{0} for the file", name)}}});
  }
}

// A complaint about something else must not hide the flag.
TEST_F(UnknownFlag, IsNamedAlsoIfMoreIsWrong) {
  const std::string flag = "unknown flag '--overwritee' (did you mean '--overwrite'?)";
  folder_.expect_refusals({{"run --overwritee", {flag}},
                           {"run a b c --overwritee", {flag}},
                           {"run --overwritee x.yaml --out", {flag}}});
}

/// No request changes the files that it reads.
class Overwrite : public InFolder {
 protected:
  Overwrite() {
    logs::write_recording(test::synthetic_log(2.0), folder_ / "a.mpack");
    logs::write_recording(test::synthetic_log(1.0), folder_ / "a.dat");
    write_tiny_experiment(folder_);
    fs::create_symlink("a.mpack", folder_ / "soft.mpack");
    fs::create_hard_link(folder_ / "a.mpack", folder_ / "hard.mpack");
    folder_.write("robot.xml", read_file(TOUCHDOWN_SOURCE_DIR "/models/upkie.xml"));
    folder_.write("own_robot.yaml", fmt::format("robot: robot.xml\n{}", folder_.text("step.yaml")));
    folder_.output_of("fit a.mpack -o m.npz --grid 20 20");
    fs::rename(folder_ / "m.npz", folder_ / "m.csv");
  }

  std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> contents;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path())) {
      const std::string name = entry.path().filename().string();
      if (name == ".stdout" || name == ".stderr") continue;
      contents[entry.path().string()] =
          entry.is_symlink()        ? fmt::format("-> {}", fs::read_symlink(entry.path()).string())
          : entry.is_regular_file() ? read_file(entry.path())
                                    : "";
    }
    return contents;
  }

  /// Every command is refused, and changes no file.
  void expect_refusals(const std::vector<Refusal>& refusals) const {
    const auto before = files();
    for (const Refusal& refusal : refusals) {
      folder_.expect_refusals({refusal});
      EXPECT_TRUE(files() == before) << refusal.arguments << " changed a file";
    }
  }
};

TEST_F(Overwrite, OfALogByItsFitIsRefused) {
  for (const std::string name : {"a.mpack", "./a.mpack", "soft.mpack", "hard.mpack"}) {
    expect_refusals(
        {{"fit a.mpack -o " + name, {"is the log itself"}},
         {"fit --contact hard.mpack --no-contact a.dat -o " + name, {"is the log itself"}}});
  }
}

TEST_F(Overwrite, OfAnythingThatACommandReadsIsRefused) {
  // A figure also writes its data and its script.
  fs::create_hard_link(folder_ / "a.mpack", folder_ / "new.gp");
  fs::create_directories(folder_ / "run" / "recordings");
  fs::copy(folder_ / "a.mpack", folder_ / "run" / "recordings" / "a.mpack");
  folder_.write("run/config.yaml", "name: x\n");
  fs::create_symlink("both.csv", folder_ / "link.mpack");
  folder_.write("both.csv", "");
  const std::string estimate = "estimate a.mpack --model m.csv ";
  expect_refusals({{estimate + "-o ./a.mpack", {"is the log itself"}},
                   {estimate + "-o soft.mpack", {"is the log itself"}},
                   {estimate + "-o hard.mpack", {"is the log itself"}},
                   {estimate + "-o m.csv", {"m.csv: is the model itself"}},
                   {"estimate - --model m.csv -o ./a.mpack <a.mpack", {"is the log itself"}},
                   {"estimate a.dat --model m.csv --figure a.png", {"a.dat: is the log itself"}},
                   {estimate + "--figure new.png", {"new.gp: is the log itself"}},
                   {estimate + "-o both.csv -o link.mpack", {"written twice"}},
                   {"simulate step.yaml -o ./step.yaml", {"is the scenario itself"}},
                   {"simulate own_robot.yaml -o robot.xml", {"is the robot itself"}},
                   {"simulate step.yaml -o /dev/null", {"/dev/null: is a device"}},
                   {"render a.mpack -o soft.mpack", {"is the recording itself"}},
                   {"render a.mpack --poster -o hard.mpack", {"is the recording itself"}},
                   {"render run -o run/recordings/a.mpack", {"is the run's own file itself"}},
                   {"render run -o run/config.yaml", {"is the run's config.yaml itself"}}});
}

TEST_F(Overwrite, IsRefusedFirstByTheOutputsExtension) {
  expect_refusals(
      {{"simulate step.yaml -o run.mp4",
        {"run.mp4: expected a recording with the extension .mpack"}},
       {"fit a.mpack -o model.txt", {"model.txt: expected a model with the extension .npz"}},
       {"render a.mpack -o film.avi", {"film.avi: expected a film with the extension .mp4"}},
       {"render a.mpack --poster -o film.mp4",
        {"film.mp4: expected a picture with the extension .png or .jpg"}}});
}

}  // namespace
}  // namespace touchdown::cli
