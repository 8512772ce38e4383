#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <unistd.h>
#include <vector>

#include "cli/verbs.hpp"
#include "core/error.hpp"

namespace touchdown::cli {

namespace {

/// Replaces this process by `touchdown-train`. libtorch is slow to load and brings another OpenGL
/// with it, so this program does not link it. Errors: `Error` if the trainer is not installed.
[[noreturn]] void execute_trainer(const std::vector<std::string>& given) {
  std::error_code ignored;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", ignored);
  std::string program = (self.parent_path() / "touchdown-train").string();
  // On a busy machine, threads that spin take the processor from the threads they wait for.
  // Sleeping costs nothing here, because parallel regions are long.
  ::setenv("OMP_WAIT_POLICY", "passive", 0);
  std::vector<std::string> words = given;
  std::vector<char*> arguments = {program.data()};
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ::execv(program.c_str(), arguments.data());
  throw Error("train: " + program +
              " is missing: `make trainer` builds it, with the packages libtorch-dev and "
              "libopenblas0-openmp");
}

}  // namespace

void add_train(CLI::App& program, const CliSession& /*session*/) {
  Verb verb(program, "train",
            "touchdown train experiments/nmn.yaml\n\n"
            "Trains the neural measurement network on simulated data. It needs libtorch.");
  verb.action_on_words(execute_trainer);  // the trainer has its own --help
}

}  // namespace touchdown::cli
