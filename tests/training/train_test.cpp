#include "apps/training/train.hpp"

#include <atomic>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include <gmock/gmock.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/fingerprint.hpp"
#include "logs/model_file.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::training {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class Train : public testing::Test {
 protected:
  Train() {
    config_.rollout.scenarios = {TOUCHDOWN_SOURCE_DIR "/scenarios/lift_drive.yaml"};
    config_.rollout.environments = 8;
    config_.rollout.steps = 50;
    config_.network = {8, 8, 4};
    config_.optimiser.iterations = 3;
    config_.optimiser.epochs = 2;
    config_.optimiser.validation_episodes = 8;
  }

  TrainingResult run(const std::string& out, int threads = 2) const {
    TrainingRequest request;
    request.out = folder_ / out;
    request.threads = threads;
    request.command = "touchdown train x.yaml";
    return train(config_, request);
  }

  TrainingConfig config_;
  const ScratchFolder scratch_;
  const std::filesystem::path folder_ = scratch_.path();
};

TEST_F(Train, WritesWeightsCurvesAndAManifest) {
  // A partial file of a killed training is removed.
  const std::filesystem::path part = folder_ / "a/checkpoints/.0003.12.0abcdef0.part.pt";
  write_atomically(part, "half");
  const TrainingResult result = run("a");
  EXPECT_FALSE(std::filesystem::exists(part));
  ASSERT_EQ(result.history.size(), 3U);
  EXPECT_EQ(result.history[2].data_seconds, 3 * 8 * 50 * 0.005);
  EXPECT_EQ(neural_network_of(load_model(result.network).arrays).hidden(), 8);
  EXPECT_EQ(read_history(result.directory / "tables" / "training.csv").size(), 3U);
  EXPECT_TRUE(std::filesystem::exists(result.figure));
  const auto manifest = nlohmann::json::parse(read_file(result.directory / "models" / "nmn.json"));
  EXPECT_EQ(manifest["fingerprint"], Fingerprint().add(read_file(result.network)).text());
  EXPECT_EQ(manifest["chosen_iteration"], result.chosen + 1);
  EXPECT_EQ(manifest["command"], "touchdown train x.yaml");
  EXPECT_EQ(to_yaml(training_from_yaml(YamlDocument::parse(manifest["config_yaml"], "m"))),
            to_yaml(config_));
}

TEST_F(Train, TheSameSeedGivesTheSameFileForAnyNumberOfThreads) {
  const std::string one = read_file(run("one", 1).network);
  EXPECT_EQ(one, read_file(run("four", 4).network));
  config_.seed = 2;
  EXPECT_NE(one, read_file(run("other").network));
}

TEST_F(Train, ResumesWhereItWasStopped) {
  const TrainingResult straight = run("straight");
  // One iteration, then the rest, as for a training that was stopped after its first.
  config_.optimiser.iterations = 1;
  run("stopped");
  config_.optimiser.iterations = 3;
  const TrainingResult resumed = run("stopped");
  EXPECT_EQ(read_file(straight.directory / "tables" / "training.csv"),
            read_file(resumed.directory / "tables" / "training.csv"));
  EXPECT_EQ(read_file(straight.network), read_file(resumed.network));
}

TEST_F(Train, LeavesTheDirectoryOfAnExperimentAlone) {
  const std::filesystem::path taken = folder_ / "taken";
  write_atomically(taken / "state" / "key", "experiment 0123 build abcd\n");
  write_atomically(taken / "config.yaml", "name: stairs\n");
  EXPECT_THROW(run("taken"), InputError);
  EXPECT_EQ(read_file(taken / "config.yaml"), "name: stairs\n");
}

TEST_F(Train, SavesNothingPartialWhenStopped) {
  const std::atomic<bool> stop = true;
  TrainingRequest request;
  request.out = folder_ / "halt";
  request.stop = &stop;
  EXPECT_ANY_THROW(train(config_, request));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "halt" / "models" / "nmn.npz"));
}

TEST_F(Train, StopsWhenItsDirectoryIsMoved) {
  config_.optimiser.iterations = 1000;
  std::thread mover([&] {
    while (!std::filesystem::exists(folder_ / "here" / "tables" / "training.csv")) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    std::filesystem::rename(folder_ / "here", folder_ / "there");
  });
  EXPECT_THAT([&] { run("here"); }, testing::ThrowsMessage<Error>(testing::HasSubstr(
                                        "here: was moved or removed during the run")));
  mover.join();
  EXPECT_FALSE(std::filesystem::exists(folder_ / "here" / "models" / "nmn.json"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "there" / "tables" / "training.csv"));
}

TEST_F(Train, StopsEarlyWithoutImprovement) {
  config_.optimiser.learning_rate = 1e-12;  // nothing learned
  config_.optimiser.patience = 1;
  config_.optimiser.iterations = 20;
  EXPECT_LT(run("early").history.size(), 20U);
}

TEST(Blas, WarnsOfOtherLibrariesThanTheRecommendedOne) {
  const std::string debian = "/usr/lib/x86_64-linux-gnu/";
  EXPECT_THAT(blas_warning(debian + "blas/libblas.so.3.11.0"),
              HasSubstr("install the package libopenblas0-openmp"));
  EXPECT_THAT(blas_warning(debian + "openblas-pthread/libblas.so.3"),
              HasSubstr("openblas-pthread"));
  EXPECT_THAT(blas_warning(debian + "openblas-openmp/libblas.so.3"), IsEmpty());
  EXPECT_THAT(blas_in_use(), HasSubstr("blas"));
}

}  // namespace
}  // namespace touchdown::training
