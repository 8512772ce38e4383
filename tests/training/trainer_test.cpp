#include "apps/training/trainer.hpp"

#include <atomic>
#include <cmath>
#include <filesystem>
#include <vector>

#include <gmock/gmock.h>

#include "apps/training/train.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "estimator/neural/forward.hpp"
#include "tests/complaint.hpp"
#include "tests/scratch_folder.hpp"
#include "toy_episodes.hpp"

namespace touchdown::training {
namespace {

using testing::HasSubstr;

NeuralNetwork start(const EpisodeBatch& data, const NetworkSize& size = {16, 16, 8}) {
  return initial_network(size, 1, data, 0.005);
}

bool equal(const NeuralNetwork& a, const NeuralNetwork& b) {
  const auto same = [](const DenseLayer& x, const DenseLayer& y) {
    return x.weight == y.weight && x.bias == y.bias;
  };
  return a.input_mean == b.input_mean && a.input_scale == b.input_scale &&
         same(a.gru_input, b.gru_input) && same(a.gru_hidden, b.gru_hidden) &&
         same(a.first, b.first) && same(a.second, b.second) && same(a.heads, b.heads);
}

TEST(InitialNetwork, StandardisesTheDataAndDependsOnTheSeed) {
  EpisodeBatch data = test::toy_episodes(50);
  for (std::size_t row = 0; row < data.contact.size(); ++row) {
    data.input[row * neural_input_count + 4] = 7.0F;  // a joint that does not move
    data.input[row * neural_input_count + 5] *= 100.0F;
  }
  const NeuralNetwork network = start(data);
  EXPECT_TRUE(equal(network, start(data)));
  EXPECT_FALSE(equal(network, initial_network({16, 16, 8}, 2, data, 0.005)));
  EXPECT_EQ(network.input_mean[4], 7.0F);
  EXPECT_EQ(network.input_scale[4], 1.0F);
  // Uniform within ±1 has a standard deviation of 1/√3.
  EXPECT_NEAR(network.input_scale[3], std::sqrt(3.0F), 0.03F);
  EXPECT_NEAR(network.input_scale[5], std::sqrt(3.0F) / 100.0F, 3e-4F);
  EXPECT_LE(network.gru_hidden.weight.cwiseAbs().maxCoeff(), 0.25F);
  EXPECT_GT(network.gru_hidden.weight.cwiseAbs().maxCoeff(), 0.24F);
}

TEST(Trainer, MatchesTheEigenImplementation) {
  const EpisodeBatch batch = test::toy_episodes(3, 100);
  const NeuralNetwork given = start(batch, {128, 256, 128});
  const Trainer trainer(given, {});
  const std::vector<float> outputs = trainer.outputs(batch);
  const auto network = std::make_shared<const NeuralNetwork>(trainer.network());
  EXPECT_TRUE(equal(*network, given)) << "kept to the bit";
  std::vector<NeuralForward> forward(3, NeuralForward(network));
  for (int step = 0; step < batch.steps; ++step) {
    const Eigen::Map<const Eigen::MatrixXf> inputs(
        &batch.input[static_cast<std::size_t>(step) * 3 * neural_input_count], neural_input_count,
        3);
    const Eigen::Map<const Eigen::MatrixXf> expected(
        &outputs[static_cast<std::size_t>(step) * 3 * neural_output_count], neural_output_count, 3);
    for (int i = 0; i < 3; ++i) {
      const Eigen::VectorXf& outputs_of_one =
          forward[static_cast<std::size_t>(i)].step(inputs.col(i));
      ASSERT_LT((outputs_of_one - expected.col(i)).cwiseAbs().maxCoeff(), 1e-5F) << step;
    }
  }
}

// An epoch of the shipped training takes many seconds: a stop must not wait for its end.
TEST(Trainer, StopsWithinAnEpochAndAnEvaluation) {
  const EpisodeBatch batch = test::toy_episodes(6);
  const int sequences = batch.steps / batch.sequence;
  for (int at = 0; at < sequences; ++at) {
    Trainer trainer(start(batch), {});
    std::atomic<int> asked = 0;
    const StopIfAsked stop = [&] {
      if (asked++ >= at) throw Stopped();
    };
    EXPECT_THROW(trainer.train_epoch(batch, stop), Stopped) << at;
    EXPECT_EQ(asked, at + 1);
    asked = 0;
    EXPECT_THROW((void)trainer.evaluate(batch, stop), Stopped) << at;
  }
}

TEST(Trainer, ResetsTheHiddenStateWhereARunBegins) {
  EpisodeBatch batch = test::toy_episodes(1);
  const Trainer trainer(start(batch), {});
  const std::vector<float> carried = trainer.outputs(batch);
  batch.keep[2] = 0.0F;
  const std::vector<float> reset = trainer.outputs(batch);
  EXPECT_EQ(carried[19 * neural_output_count], reset[19 * neural_output_count]);
  EXPECT_NE(carried[20 * neural_output_count], reset[20 * neural_output_count]);
}

TEST(Trainer, LearnsARuleWithMemory) {
  const EpisodeBatch batch = test::toy_episodes(64);
  const EpisodeBatch unseen = test::toy_episodes(64, 40, 2);
  Trainer trainer(start(batch, {32, 32, 16}), {.learning_rate = 5e-3});
  const Loss before = trainer.evaluate(unseen);
  for (int epoch = 0; epoch < 60; ++epoch) trainer.train_epoch(batch);
  const Loss after = trainer.evaluate(unseen);
  EXPECT_LT(before.accuracy, 0.7);
  EXPECT_GT(after.accuracy, 0.9);
  EXPECT_LT(after.velocity, 0.2 * before.velocity);
  EXPECT_NEAR(after.total, after.contact + after.velocity, 1e-12);
}

TEST(Trainer, GivesTheSameBitsForAnyNumberOfThreads) {
  const EpisodeBatch batch = test::toy_episodes(10);
  const auto trained = [&](int count) {
    set_training_threads(count);
    Trainer trainer(start(batch), {});
    for (int epoch = 0; epoch < 3; ++epoch) trainer.train_epoch(batch);
    return trainer.network();
  };
  const NeuralNetwork one = trained(1);
  const NeuralNetwork three = trained(3);
  EXPECT_TRUE(equal(one, three));
  EXPECT_FALSE(equal(one, start(batch)));
}

TEST(Checkpoint, ResumesToTheBit) {
  const ScratchFolder folder;
  const EpisodeBatch batch = test::toy_episodes(8);
  Trainer straight(start(batch), {});
  straight.train_epoch(batch);
  straight.save(folder / "trainer.pt");
  straight.train_epoch(batch);

  Trainer resumed(initial_network({16, 16, 8}, 99, batch, 0.005), {});
  resumed.load(folder / "trainer.pt");
  resumed.train_epoch(batch);
  EXPECT_TRUE(equal(straight.network(), resumed.network()));
}

TEST(Checkpoint, RefusesOtherFiles) {
  const ScratchFolder folder;
  const std::filesystem::path path = folder / "trainer.pt";
  const EpisodeBatch batch = test::toy_episodes(2);
  Trainer trainer(start(batch), {});
  trainer.save(path);
  const std::string whole = read_file(path);
  Trainer(start(batch, {8, 8, 8}), {}).save(path);
  for (const std::string& content :
       {read_file(path), std::string("nonsense"), whole.substr(0, whole.size() / 2)}) {
    folder.write("trainer.pt", content);
    EXPECT_THAT(complaint_of([&] { trainer.load(path); }),
                HasSubstr("is not a checkpoint of this network"));
  }
  std::filesystem::remove(path);
  EXPECT_THAT(complaint_of([&] { trainer.load(path); }),
              HasSubstr("is not a checkpoint of this network"));
}

}  // namespace
}  // namespace touchdown::training
