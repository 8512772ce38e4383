#include <filesystem>

#include <CLI/CLI.hpp>

#include "apps/training/train.hpp"
#include "core/error.hpp"
#include "core/program.hpp"
#include "core/resources.hpp"
#include "experiments/config/yaml_kind.hpp"

namespace touchdown::training {

namespace {

int run(const std::string& training, const std::vector<std::string>& overrides,
        const TrainingRequest& request) {
  const std::filesystem::path file = find_resource(training);
  if (!request.network.empty()) {
    const std::filesystem::path network = request.network;
    check_outputs({{file, "training file"}},
                  {network, std::filesystem::path(network).replace_extension("json")});
  }
  const YamlDocument document =
      experiments::completed(YamlDocument::load(file), experiments::YamlKind::training, overrides);
  const TrainingResult result = train(training_from_yaml(document), request);
  const IterationRecord& chosen = result.history[result.chosen];
  print("network   {}, of iteration {} of {}, validation loss {:.4f}\n",
        (request.network.empty() ? result.network : request.network).string(), chosen.iteration,
        result.history.size(), chosen.validation.total);
  print("results   {}\n", result.directory.string());
  if (!result.figure.empty()) print("figure    {}\n", result.figure.string());
  return good;
}

int run_program(int argc, char** argv) {
  TrainingRequest request;
  request.command = command_text("touchdown train", argc, argv);

  CLI::App program(
      "touchdown train experiments/nmn.yaml\n\n"
      "Trains the neural measurement network on simulated data.",
      "touchdown train");
  std::string training;
  std::vector<std::string> overrides;
  program.add_option("training", training, "Training file")->required();
  program
      .add_option("-o,--output", request.network, "Also write the weights here, with a manifest")
      ->type_name("FILE.npz");
  program.add_option("--out", request.out, "Run directory (default: runs/<name>/<id>)")
      ->type_name("DIR");
  program.add_option("--threads", request.threads, "Threads (default: one per core)")
      ->check(CLI::PositiveNumber);
  program
      .add_option("--set", overrides,
                  "Change a value of the file, for example optimiser.iterations=20")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  return run_command(program, argc, argv, [&] {
    request.stop = &stop_on_interrupt();
    try {
      return run(training, overrides, request);
    } catch (const Stopped&) {
      throw Stopped(
          "stopped; finished iterations are saved, and the same command continues from there");
    }
  });
}

}  // namespace

}  // namespace touchdown::training

int main(int argc, char** argv) {
  touchdown::stop_on_interrupt();
  touchdown::open_standard_streams();
  return touchdown::finished([&] { return touchdown::training::run_program(argc, argv); });
}
