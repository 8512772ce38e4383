// A run directory with files that were changed: values replaced, keys exchanged, the end cut off.
// Every command that reads them ends with one line of touchdown's own.

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.hpp"

namespace touchdown::cli {
namespace {

using Json = nlohmann::ordered_json;

/// The document with another value at each of its paths, the root included; of a list, in its first
/// item only. The values take turns.
void for_each_damage(Json document, const std::vector<Json>& values,
                     const std::function<void(const std::string& text)>& use) {
  std::size_t next = 0;
  const std::function<void(Json&)> descend = [&](Json& at) {
    const Json kept = at;
    at = values[next++ % values.size()];
    use(document.dump());
    at = kept;
    if (!at.is_structured()) return;
    std::size_t items = at.is_array() ? 1 : at.size();
    for (auto item = at.begin(); item != at.end() && items > 0; ++item, --items) descend(*item);
  };
  descend(document);
}

class DamagedRun : public InFolder {
 protected:
  DamagedRun() {
    folder_.fill("run", [](const ProgramFolder& folder) {
      folder.output_of("run " + write_tiny_experiment(folder) +
                       " --no-pictures --out run --set simulators=[mujoco] --set test.runs=1");
    });
  }

  /// Runs a command after a file of the run was replaced, and puts the file back.
  void expect_own_words(const std::string& file, const std::string& content,
                        const std::string& arguments) {
    const std::string before = folder_.text(file);
    write_atomically(folder_ / file, content);
    const Ended ended = folder_.run(arguments);
    EXPECT_TRUE(ended.exit_code >= 0 && ended.exit_code <= 2) << ended.exit_code << content;
    for (const char* const text :
         {"bad_cast", "std::", "json.exception", "yaml-cpp", "bad conversion", "invalid node",
          "filesystem error", "basic_string", "vector::", "map::at", "stod"}) {
      EXPECT_THAT(ended.errors, ::testing::Not(::testing::HasSubstr(text))) << content;
    }
    if (ended.exit_code != 0) {
      EXPECT_EQ(std::count(ended.errors.begin(), ended.errors.end(), '\n'), 1) << ended.errors;
      EXPECT_THAT(ended.errors, ::testing::StartsWith("touchdown: ")) << content;
    }
    write_atomically(folder_ / file, before);
  }
};

TEST_F(DamagedRun, JsonIsRefusedInOwnWords) {
  const std::vector<Json> values = {nullptr,       "text",         -1,        1e300,
                                    Json::array(), Json::object(), {{"a", 1}}};
  for (const std::string file : {"run/manifest.json"}) {
    const std::string text = folder_.text(file);
    int damages = 0;
    for_each_damage(Json::parse(text), values, [&](const std::string& damaged) {
      expect_own_words(file, damaged, "report run");
      ++damages;
    });
    EXPECT_GE(damages, 10);
    for (const std::string& cut :
         {std::string(), text.substr(0, 1), text.substr(0, text.size() / 2),
          std::string("\xff\xfe"), std::string("[1,2"), std::string("[]"), std::string("null"),
          std::string("{\"a\": \x80}")}) {
      expect_own_words(file, cut, "report run");
      expect_own_words(file, cut, "run tiny.yaml --no-pictures --out run");
    }
  }
}

TEST_F(DamagedRun, YamlIsRefusedInOwnWords) {
  constexpr const char* commands[] = {"report run", "run run --no-pictures",
                                      "convert --benchmark b run", "report run"};
  std::size_t next = 0;
  for (const std::string file : {"run/config.yaml", "run/state/scenario_000.yaml"}) {
    const std::string text = folder_.text(file);
    for (const std::string& damaged :
         {std::string(), std::string("~"), std::string("[]"), std::string("3"),
          text + "? [a]\n: 1\n", text + "? {a: 1}\n: 1\n", text + "~: 1\n", text + "<<: 1\n",
          text.substr(0, text.size() / 2), std::string("a: *b\n"), std::string("name: {a: 1}\n"),
          std::string("name: [x]\n")}) {
      // The commands take turns, as each of them reads both files.
      expect_own_words(file, damaged, commands[next++ % std::size(commands)]);
    }
  }
}

}  // namespace
}  // namespace touchdown::cli
