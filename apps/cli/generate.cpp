#include "scenarios/generation/generate.hpp"

#include <filesystem>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "apps/cli/verb.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/program.hpp"

namespace touchdown::cli {

namespace {

struct GenerateFlags {
  scenarios::Generation generation = {.count = 15};
  std::string output;
};

std::vector<scenarios::GeneratedScenario> draw(const scenarios::Generation& generation,
                                               const CliSession& session) {
  try {
    return scenarios::generate(generation, [&] { return !*session.stop; });
  } catch (const Stopped&) {
    throw Stopped("stopped; nothing was written");
  }
}

void generate(const GenerateFlags& flags, const CliSession& session) {
  const std::filesystem::path folder = flags.output;
  const auto file_of = [&](const scenarios::GeneratedScenario& drawn) {
    return folder / (drawn.name + ".yaml");
  };
  const std::vector<scenarios::GeneratedScenario> all = draw(flags.generation, session);
  for (const scenarios::GeneratedScenario& drawn : all) {
    if (!is_there(file_of(drawn)) || read_file(file_of(drawn)) == drawn.text) continue;
    throw InputError(fmt::format(
        "{}: is there already, and was edited or drawn by another version of touchdown: move it, "
        "or choose another -o; nothing was written",
        file_of(drawn).string()));
  }
  std::size_t written = 0;
  for (const scenarios::GeneratedScenario& drawn : all) {
    if (*session.stop) {
      throw Stopped(fmt::format("stopped; {} of {} scenarios are written in {}", written,
                                flags.generation.count, folder.string()));
    }
    ++written;
    const std::filesystem::path path = file_of(drawn);
    write_atomically(path, drawn.text);
    print("{}\n", path.string());
    for (const std::string& reason : drawn.rejected) {
      print("  an earlier draw was rejected: {}\n", reason);
    }
  }
}

}  // namespace

void add_generate(CLI::App& program, const CliSession& session) {
  Verb verb(
      program, "generate",
      "touchdown generate --seed 7 --count 30 -o scenes\n\n"
      "Draws scenarios from families of terrains, forces and motions, and writes them as files.\n"
      "The same seed gives the same files.");
  const auto flags = std::make_shared<GenerateFlags>();
  verb.option("-o,--output", &flags->output, "Folder of the scenario files")
      .value_name("DIR")
      .required();
  verb.option("--seed", &flags->generation.seed, "Seed of the draws").shows_default();
  verb.option("--count", &flags->generation.count, "Number of scenarios; families take turns")
      .shows_default()
      .between(1, 100'000);
  verb.option("--family", &flags->generation.families,
              "Only scenarios of this family; `touchdown list` has them")
      .value_name("NAME")
      .one_at_a_time();
  verb.action([flags, &session] { generate(*flags, session); });
}

}  // namespace touchdown::cli
