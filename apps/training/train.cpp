#include "apps/training/train.hpp"

#include <chrono>
#include <cmath>
#include <dlfcn.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <torch/version.h>
#include <vector>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <tbb/global_control.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/fingerprint.hpp"
#include "core/progress.hpp"
#include "core/random.hpp"
#include "experiments/run_directory/directory.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "logs/model_file.hpp"

namespace touchdown::training {

namespace {

void standardise(NeuralNetwork& network, const std::vector<float>& inputs) {
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, neural_input_count, Eigen::RowMajor>;
  const Eigen::Map<const Rows> rows(inputs.data(),
                                    static_cast<Eigen::Index>(inputs.size()) / neural_input_count,
                                    neural_input_count);
  const Eigen::Matrix<double, 1, neural_input_count> mean = rows.cast<double>().colwise().mean();
  const Eigen::Matrix<double, 1, neural_input_count> deviation =
      (rows.cast<double>().rowwise() - mean).colwise().squaredNorm().cwiseSqrt() /
      std::sqrt(static_cast<double>(rows.rows()));
  constexpr double constant = 1e-6;
  network.input_mean = mean.transpose().cast<float>();
  network.input_scale = (deviation.array() > constant)
                            .select(deviation.array().inverse(), 1.0)
                            .transpose()
                            .matrix()
                            .cast<float>();
}

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

using Json = nlohmann::ordered_json;

Json losses(const Loss& loss) {
  return {{"total", loss.total},
          {"contact_nat", loss.contact},
          {"velocity_m2_per_s2", loss.velocity},
          {"accuracy", loss.accuracy}};
}

double per_second(std::int64_t steps, double seconds) {
  return seconds > 0.0 ? static_cast<double>(steps) / seconds : 0.0;
}

struct TrainingTimes {
  double rollout = 0.0;   ///< s
  double training = 0.0;  ///< s, validation included
  std::int64_t rollout_steps = 0;
  std::int64_t training_steps = 0;  ///< times epochs
};

/// One training, from its beginning or resumed.
class TrainingSession {
 public:
  TrainingSession(const TrainingConfig& config, const TrainingRequest& request)
      : config_(config),
        request_(request),
        scenes_(training_scenes(config.rollout)),
        validation_scenes_(validation_scenes(config.rollout)),
        directory_(config.name, digest(), request.out),
        history_file_(directory_.file("tables", "training.csv")) {
    experiments::require_no_links(directory_.path());
    experiments::require_place_beside(directory_.path(), to_yaml(config), "tables/training.csv");
    directory_.keep({directory_.path(), experiments::Access::alone, request.command});
    experiments::remove_partial_files(directory_.path());
    write_atomically(directory_.own_file("", "config.yaml"), to_yaml(config));
    if (is_there(history_file_)) history_ = read_history(history_file_);
  }

  TrainingResult run() {
    if (!done()) {
      validation_ = episodes("validation", validation_scenes_, first_validation_run,
                             config_.optimiser.validation_episodes);
      resume();
      while (!done()) iterate();
    }
    return finish();
  }

 private:
  bool done() const {
    return static_cast<int>(history_.size()) >= config_.optimiser.iterations ||
           stopped_improving(history_, config_.optimiser.patience);
  }

  /// Digest of everything that determines the weights.
  std::string digest() const {
    Fingerprint print;
    print.add(to_yaml(config_)).add(noise::to_yaml(scenes_.sensors));
    for (const RolloutScenes* scenes : {&scenes_, &validation_scenes_}) {
      for (const auto& scene : scenes->scenes) print.add(scenarios::to_yaml(scene.scenario));
    }
    return print.text();
  }

  EpisodeBatch episodes(const std::string& what, const RolloutScenes& scenes, std::int64_t first,
                        int count) {
    const auto start = Clock::now();
    Progress progress(what, "runs", runs_for(config_.rollout, scenes, count));
    EpisodeBatch batch = roll_out(config_.rollout, scenes, config_.seed, first, count, [&] {
      progress.advance();
      return !request_.wants_stop();
    });
    times_.rollout += seconds_since(start);
    times_.rollout_steps += std::int64_t{batch.steps} * batch.environments;
    return batch;
  }

  EpisodeBatch training_episodes(int iteration) {
    const int count = config_.rollout.environments;
    const std::int64_t runs = runs_for(config_.rollout, scenes_, count);
    return episodes("rolling out", scenes_, (iteration - 1) * runs, count);
  }

  fs::path checkpoint(std::size_t iteration) const {
    return directory_.file("checkpoints", fmt::format("{:04}.pt", iteration));
  }

  /// Starts with a network standardised by the first iteration's data, or loads the checkpoint.
  void resume() {
    if (history_.empty()) {
      first_batch_ = std::make_unique<EpisodeBatch>(training_episodes(1));
      trainer_ = std::make_unique<Trainer>(
          initial_network(config_.network, config_.seed, *first_batch_, config_.rollout.period()),
          config_.optimiser);
      return;
    }
    trainer_ = std::make_unique<Trainer>(
        neural_network_of(load_model(directory_.file("models", "nmn.npz")).arrays),
        config_.optimiser);
    trainer_->load(checkpoint(history_.size()));
    print_message(fmt::format("resuming after iteration {}\n", history_.size()));
  }

  void iterate() {
    const int iteration = static_cast<int>(history_.size()) + 1;
    const EpisodeBatch batch =
        first_batch_ ? std::move(*first_batch_) : training_episodes(iteration);
    first_batch_.reset();
    IterationRecord record;
    record.iteration = iteration;
    record.data_seconds = iteration * batch.seconds(config_.rollout.period());
    const auto start = Clock::now();
    const StopIfAsked stop_if_asked = [&] {
      directory_.require_in_place();
      if (request_.wants_stop()) throw Stopped();
    };
    {
      const std::int64_t steps = std::int64_t{batch.steps} * batch.environments;
      Progress progress("training", "steps", steps * config_.optimiser.epochs);
      for (int epoch = 0; epoch < config_.optimiser.epochs; ++epoch) {
        record.training = trainer_->train_epoch(batch, stop_if_asked);
        progress.advance(steps);
        times_.training_steps += steps;
      }
    }
    record.validation = trainer_->evaluate(validation_, stop_if_asked);
    times_.training += seconds_since(start);
    history_.push_back(record);
    save();
  }

  /// Saves in an order that always leaves a state to resume from.
  void save() {
    directory_.require_in_place();
    const bool best = best_iteration(history_) + 1 == history_.size();
    if (best) {
      logs::save_model({.arrays = arrays_of(trainer_->network())},
                       directory_.own_file("models", "nmn.npz"));
    }
    trainer_->save(
        directory_.own_file("checkpoints", checkpoint(history_.size()).filename().string()));
    write_history(history_, directory_.own_file("tables", "training.csv"));
    std::error_code ignored;
    fs::remove(checkpoint(history_.size() - 1), ignored);
    const IterationRecord& now = history_.back();
    print_message(fmt::format(
        "iteration {}/{}: training loss {:.4f}, validation loss {:.4f} (contact {:.4f} nat, "
        "accuracy {:.2f} %; velocity {:.4f} m²/s²){}\n",
        now.iteration, config_.optimiser.iterations, now.training.total, now.validation.total,
        now.validation.contact, 100.0 * now.validation.accuracy, now.validation.velocity,
        best ? ", the best so far" : ""));
  }

  /// Metadata of the weights as JSON: configuration, data, losses and fingerprint.
  std::string manifest(const TrainingResult& result) const {
    const IterationRecord& chosen = result.history.at(result.chosen);
    Json json;
    json["network"] = config_.name;
    json["fingerprint"] = Fingerprint().add(read_file(result.network)).text();
    json["command"] = request_.command;
    json["finished_at"] = fmt::format("{:%FT%TZ}", fmt::gmtime(std::chrono::system_clock::now()));
    json["config_yaml"] = to_yaml(config_);
    json["seed"] = config_.seed;
    json["chosen_iteration"] = chosen.iteration;
    json["iterations"] = result.history.size();
    json["labelled_data_s"] = chosen.data_seconds;
    json["training_loss"] = losses(chosen.training);
    json["validation_loss"] = losses(chosen.validation);
    json["threads"] = request_.thread_count();
    json["timings_s"] = {{"rollout", times_.rollout}, {"training", times_.training}};
    json["steps_per_s"] = {{"rollout", per_second(times_.rollout_steps, times_.rollout)},
                           {"training", per_second(times_.training_steps, times_.training)}};
    json["versions"] = {{"touchdown", TOUCHDOWN_VERSION},
                        {"compiler", __VERSION__},
                        {"libtorch", TORCH_VERSION},
                        {"blas", blas_in_use()}};
    return json.dump(2) + "\n";
  }

  TrainingResult finish() {
    TrainingResult result;
    result.directory = directory_.path();
    result.network = directory_.file("models", "nmn.npz");
    result.history = history_;
    result.chosen = best_iteration(history_);
    const render::FigureFile figure(
        directory_.file("figures", "training"), {},
        [&](const std::string& file) { (void)directory_.own_file("figures", file); });
    result.figure = draw_losses(history_, figure);
    const std::string about = manifest(result);
    write_atomically(directory_.own_file("models", "nmn.json"), about);
    if (!request_.network.empty()) {
      write_atomically(request_.network, read_file(result.network));
      write_atomically(fs::path(request_.network).replace_extension("json"), about);
    }
    return result;
  }

  const TrainingConfig& config_;
  const TrainingRequest& request_;
  RolloutScenes scenes_;
  RolloutScenes validation_scenes_;
  experiments::RunDirectory directory_;
  fs::path history_file_;
  TrainingHistory history_;
  EpisodeBatch validation_;
  std::unique_ptr<EpisodeBatch> first_batch_;
  std::unique_ptr<Trainer> trainer_;
  TrainingTimes times_;
};

}  // namespace

NeuralNetwork initial_network(const NetworkSize& size, std::uint64_t seed, const EpisodeBatch& data,
                              double period) {
  NeuralNetwork network;
  network.period = period;
  standardise(network, data.input);
  constexpr std::uint64_t weights_stream = 0x77656967687473;  // "weights"
  std::uint64_t drawn = 0;
  const auto layer = [&](Eigen::Index outputs, Eigen::Index inputs, Eigen::Index fan) {
    const double bound = 1.0 / std::sqrt(static_cast<double>(fan));
    const auto draw = [&] {
      return static_cast<float>(bound * (2.0 * uniform01(seed, weights_stream, drawn++) - 1.0));
    };
    DenseLayer dense{Eigen::MatrixXf(outputs, inputs), Eigen::VectorXf(outputs)};
    for (float& weight : dense.weight.reshaped()) weight = draw();
    for (float& bias : dense.bias) bias = draw();
    return dense;
  };
  const Eigen::Index hidden = size.hidden;
  network.gru_input = layer(3 * hidden, neural_input_count, hidden);
  network.gru_hidden = layer(3 * hidden, hidden, hidden);
  network.first = layer(size.first, hidden, hidden);
  network.second = layer(size.second, size.first, size.first);
  network.heads = layer(neural_output_count, size.second, size.second);
  return network;
}

std::string blas_warning(const std::string& library) {
  const auto has = [&](const char* text) { return library.find(text) != std::string::npos; };
  constexpr const char* advice =
      "install the package libopenblas0-openmp, or choose it with "
      "'update-alternatives --config libblas.so.3-x86_64-linux-gnu'";
  if (has("/blas/libblas")) {
    return fmt::format(
        "libtorch uses the reference BLAS ({}): training will take about twenty times as long; {}",
        library, advice);
  }
  if (has("openblas-pthread") || has("openblas-serial")) {
    return fmt::format("libtorch uses {}, which does not share its threads with libtorch; {}",
                       library, advice);
  }
  return "";
}

std::string blas_in_use() {
  void* const symbol = ::dlsym(RTLD_DEFAULT, "sgemm_");
  Dl_info info = {};
  if (symbol == nullptr || ::dladdr(symbol, &info) == 0) return {};
  std::error_code ignored;
  const auto path = std::filesystem::canonical(info.dli_fname, ignored);
  return ignored ? info.dli_fname : path.string();
}

TrainingResult train(const TrainingConfig& config, const TrainingRequest& request) {
  if (const std::string warning = blas_warning(blas_in_use()); !warning.empty()) {
    print_message(fmt::format("touchdown: warning: {}\n", warning));
  }
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(request.thread_count()));
  set_training_threads(request.thread_count());
  return TrainingSession(config, request).run();
}

}  // namespace touchdown::training
