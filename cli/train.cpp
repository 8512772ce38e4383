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

/// Becomes the program that trains: libtorch is slow to load and brings another OpenGL with it, so
/// it stays out of this one.
[[noreturn]] void become_trainer(const std::vector<std::string>& given) {
  std::error_code ignored;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", ignored);
  std::string program = (self.parent_path() / "touchdown-train").string();
  // Threads that wait busily take the processor from those that they wait for once anything else
  // runs on the machine; sleeping costs nothing here, since parallel regions are long.
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
            "Trains the neural measurement network on simulated data (needs libtorch).");
  verb.action_on_words(become_trainer);  // the trainer has its own --help
}

}  // namespace touchdown::cli
