#include <algorithm>
#include <cctype>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "apps/cli/log_options.hpp"
#include "apps/cli/verb.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/program.hpp"
#include "core/progress.hpp"
#include "core/resources.hpp"
#include "core/stop.hpp"
#include "core/table.hpp"
#include "experiments/logs/estimator.hpp"
#include "experiments/logs/log_steps.hpp"
#include "experiments/logs/robot.hpp"
#include "experiments/results/captions.hpp"
#include "experiments/submissions/export.hpp"
#include "logs/log/mcap.hpp"
#include "logs/log/recording_file.hpp"
#include "logs/mapping/conversion.hpp"
#include "logs/model_file.hpp"
#include "render/report/filmed_run.hpp"
#include "render/report/mcap.hpp"

namespace touchdown::cli {

namespace {

struct ConvertFlags {
  std::string source;
  std::string folder;
  experiments::BenchmarkPart part;
  bool dry_run = false;
  std::string output;
  std::string mapping;
  std::string labels;
  bool strict = false;
  ModelUse use;
  std::vector<std::string> configuration;  ///< key=value
};

/// Prints what is implausible about the signals of the written log, one line each. Returns their
/// number.
std::size_t report_findings(const ConvertFlags& flags, const CliSession& session) {
  logs::LogReader reader(flags.output, session.stop);
  std::vector<std::string> findings;
  try {
    experiments::LogSteps log(reader);
    while (log.next() != nullptr) end_if(session.stop);
    findings = log.findings();
  } catch (const InputError& error) {
    findings = {error.what()};  // no estimator can read the log
  }
  print_findings(flags.source, findings);
  return findings.size();
}

/// Errors: `InputError` for a log without contact labels.
std::string labels_text(const ConvertFlags& flags, const logs::ConvertedLog& log) {
  if (log.contact.intervals.empty()) {
    throw InputError(fmt::format(
        "--labels: {} has no contact labels: expected a section 'contact' in {}, and numbers",
        flags.source, flags.mapping));
  }
  return logs::to_csv(log.contact);
}

/// A log with the robot to draw: the one of a recording, or the named one on flat ground. Nothing
/// for a log without either, and for a live stream.
std::optional<render::FilmedRun> drawable(const std::string& log, const std::string& robot,
                                          const logs::RecordingInfo& info,
                                          const CliSession& session) {
  if (log == "-") return std::nullopt;
  std::vector<std::string> warnings;  // the reader of the log prints them
  if (!robot.empty()) {
    logs::LogReader reader(log, session.stop);
    return render::FilmedRun{models::compile_robot_model(find_resource(robot), {}),
                             logs::read_recording(reader, &warnings),
                             {},
                             {}};
  }
  if (info.scenario_yaml.empty()) return std::nullopt;
  return render::filmed_recording(log, warnings, session.stop);
}

/// Converts the log to Upkie's layout, writes its contact column as labels and prints a summary.
/// Errors: `InputError`; nothing is written then.
void write_log(const ConvertFlags& flags, const CliSession& session) {
  require_extension(flags.output, {".mpack"}, "a log");
  std::vector<std::filesystem::path> outputs = {flags.output};
  if (!flags.labels.empty()) outputs.emplace_back(flags.labels);
  std::vector<InputFile> inputs;
  add_log(flags.source, flags.mapping, inputs);
  check_outputs(inputs, outputs);
  logs::ConvertedLog log;
  write_stream_atomically(flags.output, [&](std::ostream& stream) {
    log = logs::convert_log(flags.source, flags.mapping, stream,
                            {.stop = session.stop, .with_labels = !flags.labels.empty()});
    stream.flush();  // labels only beside a whole log
    if (!stream) return;
    if (!flags.labels.empty()) write_atomically(flags.labels, labels_text(flags, log));
  });
  print_warnings(log.warnings);
  const std::size_t findings = report_findings(flags, session);
  print("log       {}, {} records, from {} to {} s of {}\n", flags.output, log.rows,
        fixed(log.start, 3), fixed(log.end, 3), flags.source);
  if (!flags.labels.empty()) {
    print("labels    {}, {} intervals\n", flags.labels, log.contact.intervals.size());
  }
  print("next      touchdown estimate {}{}\n", flags.output,
        flags.labels.empty() ? "" : fmt::format(" --labels {}", flags.labels));
  if (flags.strict) require_no_findings(findings);
}

/// Writes a log, with the beliefs in it, as an MCAP file and prints a summary. If the log contains
/// its scene, or a `robot` is named, the file shows it too. Errors: as above.
void write_mcap_file(const std::string& log, const std::string& robot, const std::string& output,
                     const CliSession& session) {
  check_outputs({{log, "log"}}, {output});
  logs::LogReader reader(log, session.stop);
  std::uint64_t rows = 0;
  const std::optional<render::FilmedRun> run = drawable(log, robot, reader.info(), session);
  end_if(session.stop);
  write_stream_atomically(output, [&](std::ostream& stream) {
    rows = run ? render::write_mcap_with_scene(reader, stream, run->robot, run->recording)
               : logs::write_mcap(reader, stream);
    end_if(session.stop);
  });
  print_warnings(reader.warnings());
  print("log       {}, {} records, {:.1f} MB\n", output, rows,
        1e-6 * static_cast<double>(size_of_file(output)));
}

/// A C++ identifier from the header's file name. Errors: `InputError` if the extension is not a
/// header's.
std::string name_of(const std::filesystem::path& header) {
  const std::string extension = header.extension().string();
  if (extension != ".hpp" && extension != ".h") {
    throw InputError(fmt::format(
        "-o: {}: expected a header, FILE.hpp, or a model, FILE.npz; of a log, FILE.mcap",
        header.string()));
  }
  std::string name = header.stem().string();
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return std::isdigit(static_cast<unsigned char>(name.front())) != 0 ? "model_" + name : name;
}

/// Errors: `InputError` for an assignment that is not key=value, or for a key that has another one.
ConfigurationText configuration_of(const std::vector<std::string>& assignments) {
  ConfigurationText configuration;
  for (const std::string& one : assignments) {
    const std::size_t equals = one.find('=');
    if (equals == 0 || equals == std::string::npos) {
      throw InputError(fmt::format("--set: {}: expected NAME=VALUE, as in leave_below=0.05", one));
    }
    const std::string name = one.substr(0, equals);
    if (!configuration.emplace(name, one.substr(equals + 1)).second) {
      throw InputError(fmt::format("--set: {}: '{}' is set twice", one, name));
    }
  }
  return configuration;
}

/// The intended use of the model according to the flags.
ModelUse use_of(const ConvertFlags& flags) {
  ModelUse use = flags.use;
  if (!flags.part.robots.empty()) {
    const experiments::LogRobot robot = experiments::robot_called(flags.part.robots.front());
    use.robot = robot.name;
    use.geometry = robot.legs;
  }
  use.configuration = configuration_of(flags.configuration);
  return use;
}

bool is_robot(const std::filesystem::path& source) {
  const std::string extension = source.extension().string();
  return extension == ".xml" || extension == ".urdf" || extension == ".yaml";
}

/// The model of the file, or the filter of loads of the robot that the file describes.
Model source_model(const std::filesystem::path& source, const ConvertFlags& flags) {
  if (!is_robot(source)) return logs::load_model_for(source, use_of(flags));
  const experiments::LogRobot robot = experiments::robot_of_file(source.string());
  constexpr double usual_rate = 1000.0;  // Hz; the filter serves others, too
  return model_for(load_filter_model(robot.legs.value(), usual_rate, robot.name),
                   {.configuration = configuration_of(flags.configuration)});
}

void write_header(const std::filesystem::path& source, const ConvertFlags& flags) {
  const std::string name = name_of(flags.output);
  const std::string text =
      logs::header_of_model(source_model(source, flags), source.filename().string(), name);
  write_atomically(flags.output, text);
  print("header    {}, {:.0f} kB\n", flags.output, 1e-3 * static_cast<double>(text.size()));
  print("next      #include \"{}\"; touchdown::make_estimator(touchdown::compiled::{})\n",
        std::filesystem::path(flags.output).filename().string(), name);
}

void write_model(const ConvertFlags& flags) {
  const std::filesystem::path source = find_resource(flags.source);
  check_outputs({{source.string(), source.extension() == ".npz" ? "model" : "robot"}},
                {flags.output});
  if (std::filesystem::path(flags.output).extension() != ".npz") {
    return write_header(source, flags);
  }
  const Model adapted = source_model(source, flags);
  logs::save_model(adapted, flags.output);
  const ModelMetadata& metadata = *adapted.metadata;
  print("model     {}, for '{}' at {:.6g} Hz on {}, fingerprint {}\n", flags.output,
        metadata.estimator, metadata.sample_rate, experiments::robot_text(metadata.robot),
        metadata.fingerprint);
  print("next      touchdown estimate LOG --model {}\n", flags.output);
}

void write_signals(const ConvertFlags& flags, const CliSession& session) {
  const experiments::ExportRequest request{flags.source, flags.folder, flags.part};
  if (flags.dry_run) {
    print("{}", experiments::export_outline(request));
    return;
  }
  const experiments::ExportReport report = experiments::export_benchmark(
      request, {.out = {}, .command = session.command, .stop = session.stop});
  if (!report.failed.empty()) {
    print_message(
        fmt::format("touchdown: {} runs fell and are not scored, so they are left out: {}\n",
                    report.failed.size(), fmt::join(report.failed, ", ")));
  }
  print("signals   {}, {:.1f} MB, in {}\n", experiments::plural(report.files, "file"),
        1e-6 * static_cast<double>(report.bytes), flags.folder);
  print("read      {0}/README.md, {0}/index.csv\n", flags.folder);
  print("next      touchdown score RUN --beliefs FOLDER --name NAME\n");
}

/// Errors: `InputError` for an option that is not for this conversion.
void refuse_others(const ConvertFlags& flags) {
  const ModelUse& use = flags.use;
  const experiments::BenchmarkPart& part = flags.part;
  const bool signals = !flags.folder.empty();
  const bool log = !signals && !flags.mapping.empty();
  const bool mcap = !log && std::filesystem::path(flags.output).extension() == ".mcap";
  const bool robot = !signals && !log && !mcap && is_robot(flags.source);
  const bool model = !signals && !log && !mcap && !robot;
  using Given = std::pair<const char*, bool>;
  const auto only_for = [](bool is_for, const std::vector<Given>& options, const char* expected) {
    for (const auto& [option, is_given] : options) {
      if (is_given && !is_for) throw InputError(fmt::format("{}: expected {}", option, expected));
    }
  };
  only_for(log, {{"--mapping", !flags.mapping.empty()}}, "-o FILE.mpack, for a log");
  only_for(log, {{"--labels", !flags.labels.empty()}, {"--strict", flags.strict}},
           "--mapping FILE.yaml, for a log in another layout");
  only_for(signals,
           {{"--sensors", !part.sensors.empty()},
            {"--simulator", !part.simulators.empty()},
            {"--dry-run", flags.dry_run}},
           "--benchmark DIR, for a benchmark's signals");
  only_for(model, {{"--estimator", !use.estimator.empty()}, {"--rate", use.sample_rate != 0.0}},
           "a model to convert");
  only_for(model || robot, {{"--set", !flags.configuration.empty()}}, "a model or a robot");
  only_for(signals || mcap || model, {{"--robot", !part.robots.empty()}},
           "a benchmark, a model or a log as FILE.mcap");
}

void convert(const ConvertFlags& flags, const CliSession& session) {
  if (flags.output.empty() == flags.folder.empty()) {
    throw InputError(
        "convert: expected either --benchmark DIR, for a benchmark's signals, or -o FILE.hpp or "
        "FILE.npz, for a model or a robot, or --mapping FILE.yaml -o FILE.mpack, for a log in "
        "another layout, "
        "or -o FILE.mcap, for a log in Upkie's layout");
  }
  refuse_others(flags);
  if (flags.mapping.empty() && std::filesystem::path(flags.output).extension() == ".mpack") {
    throw InputError(
        fmt::format("-o: {}: expected --mapping FILE.yaml, which describes the columns of {}",
                    flags.output, flags.source));
  }
  const bool is_own_log = std::filesystem::path(flags.source).extension() == ".mpack";
  if (is_own_log && !flags.output.empty() &&
      std::filesystem::path(flags.output).extension() != ".mcap") {
    throw InputError(fmt::format("-o: {}: expected FILE.mcap: a log in Upkie's layout becomes MCAP",
                                 flags.output));
  }
  if (!flags.mapping.empty()) {
    write_log(flags, session);
  } else if (std::filesystem::path(flags.output).extension() == ".mcap") {
    write_mcap_file(flags.source, flags.part.robots.empty() ? "" : flags.part.robots.front(),
                    flags.output, session);
  } else if (!flags.output.empty()) {
    write_model(flags);
  } else {
    write_signals(flags, session);
  }
}

}  // namespace

void add_convert(CLI::App& program, const CliSession& session) {
  Verb verb(
      program, "convert",
      "touchdown convert --benchmark signals experiments/benchmark.yaml\n"
      "touchdown convert --benchmark signals runs/benchmark/latest --robot upkie\n"
      "touchdown convert model.npz -o model.hpp\n"
      "touchdown convert my_robot.yaml -o my_robot.hpp\n"
      "touchdown convert robot.csv --mapping robot.yaml -o robot.mpack\n"
      "touchdown convert rosbag2_2026_03_01/ --mapping robot.yaml -o robot.mpack\n"
      "touchdown convert robot.mpack -o robot.mcap\n\n"
      "Converts a benchmark's signals, a model or a log. A benchmark's signals are for an\n"
      "external estimator in any language; `touchdown score` scores its beliefs. A model becomes\n"
      "a C++ header for a robot without files, or another model file, with other\n"
      "hyperparameters if --set names them. A robot's file becomes the model of its load_filter,\n"
      "for programs in C and C++.\n"
      "A log of another robot, as CSV, NumPy arrays or a ROS 2 bag, becomes a log in Upkie's\n"
      "layout, which all other commands read. A log in Upkie's layout, with the beliefs of "
      "`estimate`,\n"
      "becomes an MCAP file for Foxglove.");
  const auto flags = std::make_shared<ConvertFlags>();
  verb.option("source", &flags->source,
              "Experiment file with a section `benchmark`, or its run directory; or a model that "
              "`touchdown fit` wrote; or a robot's file; or a log as .csv, .npz or .mpack, or a "
              "ROS 2 bag (its "
              "folder, .mcap "
              "or .db3)")
      .value_name("RUN_OR_EXPERIMENT_OR_MODEL_OR_ROBOT_OR_LOG")
      .required();
  verb.option("--benchmark", &flags->folder, "New or empty folder for a benchmark's signals")
      .value_name("DIR");
  verb.option("-o,--output", &flags->output,
              "Model as FILE.hpp or FILE.npz, or log as FILE.mpack or FILE.mcap")
      .value_name("FILE");
  verb.option("--mapping", &flags->mapping,
              "Maps the columns of the log to signals, with units, signs and order")
      .value_name("FILE.yaml");
  verb.option(
          "--labels", &flags->labels,
          "With --mapping: writes the log's contact labels as start,end,left,right, for `fit` and "
          "`estimate`")
      .value_name("FILE.csv");
  verb.flag("--strict", &flags->strict,
            "With --mapping: exit with code 1 if the signals of the log are not plausible");
  verb.option("--estimator", &flags->use.estimator,
              "For a model without metadata: the estimator that it was fitted for");
  verb.option("--rate", &flags->use.sample_rate,
              "For a model without metadata: the rate that it was fitted at (Hz)")
      .between(1.0, 1e6);
  verb.option("--robot", &flags->part.robots,
              "Only this robot, as the benchmark's table names it. For a model: the robot\n"
              "that it is for. For a log as FILE.mcap: the robot to show, if the log does not "
              "contain it")
      .value_name("NAME|FILE")
      .one_at_a_time();
  verb.option("--set", &flags->configuration,
              "The model with another value of a hyperparameter, for example leave_below=0.05")
      .value_name("NAME=VALUE")
      .one_at_a_time();
  verb.option("--sensors", &flags->part.sensors,
              "Only these sensors, as the benchmark's table names them")
      .value_name("NAME")
      .one_at_a_time();
  verb.option("--simulator", &flags->part.simulators, "Only this physics engine")
      .value_name("NAME")
      .one_at_a_time();
  verb.flag("--dry-run", &flags->dry_run, "Only show the number of files and their size");
  verb.action([flags, &session] { convert(*flags, session); });
}

}  // namespace touchdown::cli
