#include "apps/cli/estimate_outputs.hpp"

#include <algorithm>
#include <iostream>
#include <set>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/program.hpp"

namespace touchdown::cli {

namespace {

namespace fs = std::filesystem;

fs::path named_after(const std::string& log, const fs::path& output) {
  if (output.empty() || output == "-") return output;
  const std::string stem = log == "-" ? "stdin" : fs::path(log).stem().string();
  return output.parent_path() / (stem + "_" + output.filename().string());
}

EstimateOutputs sorted_by_kind(const EstimateRequest& request) {
  EstimateOutputs result;
  const auto take = [](fs::path& path, const std::string& output) {
    if (!path.empty()) {
      throw InputError(
          fmt::format("--output: '{}' and '{}' are of one kind", path.string(), output));
    }
    path = output;
  };
  for (const std::string& output : request.outputs) {
    const fs::path extension = fs::path(output).extension();
    if (output == "-" || extension == ".csv") {
      take(result.csv, output);
    } else if (extension == ".mpack") {
      take(result.mpack, output);
    } else if (extension == ".mcap") {
      take(result.mcap, output);
    } else {
      throw InputError(
          fmt::format("--output: '{}': expected a name that ends with .csv (a table of beliefs), "
                      ".mpack (the log with beliefs in it) or .mcap (a ROS 2 bag of beliefs), or - "
                      "for standard output",
                      output));
    }
  }
  result.figure = figure_stem(request.figure);
  result.proposal = request.proposal;
  if (!request.proposal.empty() && extension_of(result.proposal) != ".csv") {
    throw InputError(
        fmt::format("--propose: '{}': expected a name that ends with .csv", request.proposal));
  }
  return result;
}

void check(const fs::path& output, std::set<fs::path>& seen) {
  if (output.empty() || output == "-") return;
  if (!seen.insert(absolute_path(output).lexically_normal()).second) {
    throw InputError(fmt::format("{}: would be written twice: name another file", output.string()));
  }
}

void write_file(const fs::path& path, const std::function<void(std::ostream*)>& use) {
  if (path.empty()) {
    use(nullptr);
  } else if (path == "-") {
    use(&std::cout);
  } else {
    write_stream_atomically(path, [&](std::ostream& file) { use(&file); });
  }
}

}  // namespace

fs::path figure_stem(const std::string& figure) {
  const fs::path path = figure;
  const std::set<fs::path> known = {"", ".png", ".svg", ".pdf"};
  if (!known.contains(path.extension())) {
    throw InputError(fmt::format(
        "--figure: '{}': expected a name that ends with .png; .svg and .pdf come with it", figure));
  }
  return path.parent_path() / path.stem();
}

std::vector<fs::path> figure_files(const fs::path& stem) {
  std::vector<fs::path> files;
  if (stem.empty()) return files;
  for (const char* const extension : {".png", ".svg", ".pdf", ".gp", ".dat"}) {
    files.push_back(stem.string() + extension);
  }
  return files;
}

std::vector<EstimateOutputs> estimate_outputs(const std::vector<std::string>& logs,
                                              const LogOptions& options,
                                              const std::vector<std::string>& labels,
                                              const EstimateRequest& request) {
  EstimateOutputs given = sorted_by_kind(request);
  const bool live = std::find(logs.begin(), logs.end(), "-") != logs.end();
  if (live && logs.size() > 1) throw InputError("estimate: '-', a live stream, is read alone");
  if (live && given.csv.empty()) given.csv = "-";
  std::vector<EstimateOutputs> all;
  std::set<fs::path> seen;
  std::vector<InputFile> inputs = {{options.model, "model"}};
  for (const std::string& file : labels) inputs.push_back({file, "file of labels"});
  for (const std::string& log : logs) add_log(log, options.mapping, inputs);
  std::vector<fs::path> files;
  std::set<fs::path> styles;  // one style file for all figures of a folder
  for (const std::string& log : logs) {
    EstimateOutputs own = given;
    if (logs.size() > 1) {
      own = {named_after(log, given.csv), named_after(log, given.mpack),
             named_after(log, given.mcap), named_after(log, given.figure),
             named_after(log, given.proposal)};
    }
    for (const fs::path& output : {own.csv, own.mpack, own.mcap, own.figure, own.proposal}) {
      check(output, seen);
      if (!output.empty() && output != own.figure) files.push_back(output);
    }
    for (const fs::path& file : figure_files(own.figure)) files.push_back(file);
    if (!own.figure.empty()) styles.insert(own.figure.parent_path() / "style.gp");
    all.push_back(own);
  }
  files.insert(files.end(), styles.begin(), styles.end());
  check_outputs(inputs, files);
  return all;
}

void write_outputs(const EstimateOutputs& outputs,
                   const std::function<void(const EstimateStreams& streams)>& use) {
  write_file(outputs.csv, [&](std::ostream* csv) {
    write_file(outputs.mpack, [&](std::ostream* mpack) {
      write_file(outputs.mcap, [&](std::ostream* mcap) { use({csv, mpack, mcap}); });
    });
  });
}

}  // namespace touchdown::cli
