#include <cstdlib>
#include <filesystem>
#include <string>
#include <unistd.h>
#include <vector>

#include "apps/cli/verb.hpp"
#include "core/error.hpp"

namespace touchdown::cli {

namespace {

/// Replaces this process by the program `name` beside it. Errors: `Error` with `remedy` if it is
/// not installed.
[[noreturn]] void execute(const std::string& name, const std::vector<std::string>& given,
                          const std::string& remedy) {
  std::error_code ignored;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", ignored);
  std::string program = (self.parent_path() / name).string();
  std::vector<std::string> words = given;
  std::vector<char*> arguments = {program.data()};
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ::execv(program.c_str(), arguments.data());
  throw Error(program + " is missing: " + remedy);
}

}  // namespace

// libtorch is slow to load and brings another OpenGL with it, so this program does not link it.
void add_train(CLI::App& program, const CliSession& /*session*/) {
  Verb verb(program, "train",
            "touchdown train experiments/nmn.yaml\n\n"
            "Trains the neural measurement network on simulated data. It needs libtorch.");
  verb.action_on_words([](const std::vector<std::string>& words) {
    // On a busy machine, threads that spin take the processor from the threads they wait for.
    // Sleeping costs nothing here, because parallel regions are long.
    ::setenv("OMP_WAIT_POLICY", "passive", 0);
    execute("touchdown-train", words,  // the trainer has its own --help
            "`make trainer` builds it, with the packages libtorch-dev and libopenblas0-openmp");
  });
}

// Windows bring the display's OpenGL with them, which off-screen drawing must not meet.
void add_watch(CLI::App& program, const CliSession& /*session*/) {
  Verb verb(program, "watch",
            "touchdown watch scenarios/stairs.yaml\n"
            "touchdown watch robot.mpack --labels labels.csv --film robot.mp4\n\n"
            "Shows a robot in a window, live or from a log, while estimators run on it. It needs "
            "GLFW and Dear ImGui.");
  verb.action_on_words([](const std::vector<std::string>& words) {
    execute(
        "touchdown-watch", words,
        "`make viewer` installs its packages and builds it; `touchdown render` makes films without "
        "it");
  });
}

}  // namespace touchdown::cli
