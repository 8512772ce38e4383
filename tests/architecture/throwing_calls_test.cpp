#include "tests/architecture/throwing_calls.hpp"

#include <filesystem>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "tests/architecture/source_tree.hpp"

namespace touchdown::tests {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

const std::filesystem::path checkout = TOUCHDOWN_SOURCE_DIR;

/// Callers get an `Error` with the file's name: these catch the standard library's own.
const std::set<std::string> catch_it_themselves = {"core/files.cpp",
                                                   "experiments/run_directory/directory.cpp"};

TEST(StandardFilesystem, IsCalledWithoutExceptions) {
  const SourceTree tree = source_tree_in(
      checkout, {"apps", "core", "estimator", "experiments", "logs", "models", "noise", "policies",
                 "render", "scenarios", "scoring", "simulators"});
  ASSERT_GT(tree.files.size(), 500U);
  std::vector<std::string> calls;
  for (const SourceFile& file : tree.files) {
    if (catch_it_themselves.contains(file.name)) continue;
    for (const std::string& call : throwing_calls(file.name, read_file(checkout / file.name))) {
      calls.push_back(call);
    }
  }
  EXPECT_THAT(calls, IsEmpty()) << "core/files.hpp has functions that throw touchdown's errors";
}

TEST(ThrowingCalls, AreThoseWithoutAnErrorCode) {
  EXPECT_THAT(throwing_calls("a.cpp", "fs::rename(a, b);\n\nif (std::filesystem::exists(path)) {"),
              ElementsAre("a.cpp:1: rename", "a.cpp:3: exists"));
  EXPECT_THAT(throwing_calls("a.cpp", "fs::rename(a, folder / name(b, c));"),
              ElementsAre("a.cpp:1: rename"));
  EXPECT_THAT(throwing_calls("a.cpp", "for (const auto& e : fs::directory_iterator(f, ignored)) {"),
              ElementsAre("a.cpp:1: directory_iterator"))
      << "its steps throw";
  EXPECT_THAT(throwing_calls("a.cpp", "fs::temp_directory_path() / x; fs::relative(a, b);"),
              ElementsAre("a.cpp:1: temp_directory_path", "a.cpp:1: relative"));
}

TEST(ThrowingCalls, AreNotThoseWithOne) {
  for (const char* const text :
       {"fs::rename(a / b.filename(), at(c, d),\n  error);", "fs::exists(path, ignored)",
        "fs::exists(fs::symlink_status(path, ignored))", "fs::temp_directory_path(error)",
        "fs::path(a)", "files.exists(path)", "fs::directory_iterator entry(folder, error);"}) {
    EXPECT_THAT(throwing_calls("a.cpp", text), IsEmpty()) << text;
  }
}

}  // namespace
}  // namespace touchdown::tests
