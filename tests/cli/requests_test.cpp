#include <algorithm>
#include <cctype>
#include <functional>
#include <regex>
#include <set>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/table.hpp"
#include "program.hpp"

namespace touchdown::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// What is added to the smallest experiment, x.yaml; a command; words of the complaint.
struct WrongCase {
  const char* added;
  std::string command;
  std::vector<std::string> words;
};

TEST(WrongRequest, IsOneLineWithThePlaceAndTheNearestName) {
  const ScratchFolder folder;
  write_tiny_experiment(folder);
  folder.write("x.mpack", "no log");
  folder.write("broken.yaml", "name: [tiny\n");
  for (const auto& [added, command, words] : std::vector<WrongCase>{
           {"", "rnu x.yaml", {"unknown command 'rnu'", "did you mean 'run'?"}},
           {"", "run", {"experiment"}},
           {"",
            "run experiments/stiars.yaml",
            {"experiments/stiars.yaml: no such file", "did you mean 'experiments/stairs.yaml'?"}},
           {"sensors: noise/profiles/upkei.yaml\n",
            "run x.yaml --dry-run",
            {"x.yaml:4:10: sensors: noise/profiles/upkei.yaml: no such file",
             "did you mean 'noise/profiles/upkie.yaml'?"}},
           {"sensors: noise/profiles/upkei.yaml\n", "run x.yaml", {"x.yaml:4:10: sensors: "}},
           {"noise:\n  sedes: 3\n",
            "run x.yaml",
            {"x.yaml:5:3: noise.sedes", "did you mean 'seeds'?"}},
           {"seed: many\n", "run x.yaml", {"x.yaml:4:7: seed", "expected a whole number"}},
           {"noise: {seeds: 0}\n", "run x.yaml", {"noise.seeds", "from 1 to"}},
           {"simulators: [mujco]\n",
            "run x.yaml",
            {"x.yaml:4:14: simulators", "did you mean 'mujoco'?"}},
           {"", "simulate step.yaml --simulator bulet -o new.mpack", {"bullet"}},
           {"estimators: [robst]\n", "run x.yaml", {"did you mean 'robust'?"}},
           {"highlights: [{torque: 0.5, accelerometer: 0.0}]\n",
            "run x.yaml",
            {"highlights.0.torque"}},
           {"", "run x.yaml --set noise.sedes=3", {"did you mean 'seeds'?"}},
           {"", "run x.yaml --set noise", {"key=value"}},
           {"", "run broken.yaml", {"not valid YAML"}},
           {"",
            "run experiments/nmn.yaml",
            {"experiments/nmn.yaml: is a training file; try: touchdown train "}},
           {"",
            "run scenarios/stairs.yaml",
            {"scenarios/stairs.yaml: is a scenario; try: touchdown simulate "}},
           {"",
            "simulate experiments/stairs.yaml -o new.mpack",
            {"experiments/stairs.yaml: is an experiment; try: touchdown run "}},
           {"", "render x.mpack -o new.mp4", {"x.mpack"}},
           {"", "render missing.mpack -o new.mp4", {"missing.mpack"}},
           {"", "render scenarios/stairs.yaml -o new.mp4", {"no such file"}},
           {"",
            "render step.yaml -o new.mp4",
            {"`touchdown simulate` makes such a log of a scenario"}}}) {
    folder.write("x.yaml", std::string("name: tiny\nfit: {scenarios: [step.yaml]}\n"
                                       "test: {scenarios: [step.yaml]}\n") +
                               added);
    const Ended ended = touchdown_program(command, folder.path());
    EXPECT_EQ(ended.exit_code, 2) << command;
    EXPECT_EQ(ended.output, "") << command;
    EXPECT_EQ(std::count(ended.errors.begin(), ended.errors.end(), '\n'), 1) << ended.errors;
    EXPECT_THAT(ended.errors, StartsWith("touchdown: ")) << command;
    for (const std::string& word : words) EXPECT_THAT(ended.errors, HasSubstr(word)) << command;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "new.mpack"));
  EXPECT_FALSE(std::filesystem::exists(folder / "new.mp4"));
}

TEST(Help, BeginsWithAnExample) {
  for (const std::string verb : {"", "run", "simulate", "render", "fit", "estimate"}) {
    const Ended ended = touchdown_program(verb + " --help", ScratchFolder().path());
    EXPECT_EQ(ended.exit_code, 0);
    EXPECT_THAT(ended.output, StartsWith("touchdown " + (verb.empty() ? "run" : verb) + " "));
  }
}

TEST(List, NamesExperimentsScenariosEnginesAndEstimators) {
  const Ended ended = touchdown_program("list", ScratchFolder().path());
  EXPECT_EQ(ended.exit_code, 0);
  for (const char* name : {"experiments/stairs.yaml", "scenarios/stairs.yaml", "mujoco", "bullet",
                           "robust", "always_contact"}) {
    EXPECT_THAT(ended.output, HasSubstr(name));
  }
}

TEST(List, DescribesEachFileInOneShortSentence) {
  constexpr std::size_t longest = 95;
  const Ended ended = touchdown_program("list", ScratchFolder().path());
  const std::regex file_line("\n  \\S+\\.yaml +([^\n]*)");
  int files = 0;
  for (std::sregex_iterator found(ended.output.begin(), ended.output.end(), file_line), end;
       found != end; ++found, ++files) {
    const std::string sentence = found->str(1);
    EXPECT_THAT(sentence, ::testing::EndsWith("."));
    EXPECT_LE(width(sentence), longest) << sentence;
  }
  EXPECT_GE(files, 50);
}

/// All matches of a group in a text.
std::vector<std::string> found_in(const std::string& text, const char* pattern) {
  const std::regex shape(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), shape), end; match != end; ++match) {
    found.push_back(match->str(1));
  }
  return found;
}

struct VerbFlags {
  std::string verb;  ///< empty for the program itself
  std::vector<std::string> long_flags;
};

/// Every verb that is built, with the long flags that its help lists.
std::vector<VerbFlags> all_flags(const std::filesystem::path& folder) {
  std::vector<std::string> verbs =
      found_in(touchdown_program("--help", folder).output, "\n  ([a-z]+)  +touchdown ");
  verbs.insert(verbs.begin(), "");
  std::vector<VerbFlags> all;
  for (const std::string& verb : verbs) {
    const Ended help = touchdown_program(verb + " --help", folder);
    if (help.exit_code != 0) continue;  // `train` and `watch` are programs of their own
    const std::string options = help.output.substr(help.output.find("Options:"));
    all.push_back({verb, found_in(options, "\n  (?:-[a-z],)?(--[a-z-]+)")});
  }
  return all;
}

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
TEST(UnknownFlag, OfAnyCommandNamesTheFlagThatWasMeant) {
  const ScratchFolder folder;
  std::size_t next = 0;
  int tried = 0;
  std::set<std::string> kinds;
  for (const VerbFlags& verb : all_flags(folder.path())) {
    for (const std::string& flag : verb.long_flags) {
      if (flag.size() < 6) continue;  // a typo of "--to" is near to anything
      const Typo& typo = typos().at(next++ % typos().size());
      const std::string word = typo.of(flag);
      if (is_other_flag(word, verb) || is_ambiguous(word, flag, verb)) continue;
      SCOPED_TRACE(fmt::format("{} {} ({})", verb.verb, word, typo.kind));
      const Ended ended = touchdown_program(fmt::format("{} {}", verb.verb, word), folder.path());
      EXPECT_EQ(ended.exit_code, 2);
      EXPECT_EQ(std::count(ended.errors.begin(), ended.errors.end(), '\n'), 1) << ended.errors;
      EXPECT_THAT(ended.errors, HasSubstr(fmt::format("unknown flag '{}' (did you mean '{}'?)",
                                                      word.substr(0, word.find('=')), flag)));
      kinds.insert(typo.kind);
      ++tried;
    }
  }
  EXPECT_GE(tried, 80);
  EXPECT_EQ(kinds.size(), typos().size());
}

TEST(UnknownFlag, ThatIsNearNoFlagListsAllOfThem) {
  const ScratchFolder folder;
  for (const VerbFlags& verb : all_flags(folder.path())) {
    const Ended ended = touchdown_program(verb.verb + " --qqqqqqqqqqqqqqqqqqqq x", folder.path());
    EXPECT_EQ(ended.exit_code, 2);
    for (const std::string& flag : verb.long_flags) {
      EXPECT_THAT(ended.errors, HasSubstr(flag)) << verb.verb;
    }
  }
}

TEST(UnknownFlag, OfOneLetterNamesAFlagThatBeginsWithIt) {
  const ScratchFolder folder;
  EXPECT_THAT(touchdown_program("-v", folder.path()).errors,
              HasSubstr("did you mean '--version'?"));
  EXPECT_THAT(touchdown_program("estimate -e x log", folder.path()).errors,
              HasSubstr("did you mean '--estimator'?"));
  EXPECT_THAT(touchdown_program("fit -z", folder.path()).errors, HasSubstr("known: "));
}

TEST(UnknownFlag, ThatIsAFileShowsHowToNameIt) {
  const ScratchFolder folder;
  for (const char* name : {"-run.mpack", "--out", "-r"}) {
    folder.write(name, "");
    EXPECT_THAT(touchdown_program(fmt::format("check {}", name), folder.path()).errors,
                HasSubstr(fmt::format("unknown flag '{0}': write ./{0} for the file", name)));
  }
}

// A complaint about something else must not hide the flag.
TEST(UnknownFlag, IsNamedAlsoIfMoreIsWrong) {
  const ScratchFolder folder;
  for (const char* line :
       {"run --overwritee", "run a b c --overwritee", "run --overwritee x.yaml --out"}) {
    EXPECT_THAT(touchdown_program(line, folder.path()).errors,
                HasSubstr("unknown flag '--overwritee' (did you mean '--overwrite'?)"))
        << line;
  }
}

}  // namespace
}  // namespace touchdown::cli
