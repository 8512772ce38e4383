#include "experiments/batch/neural.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "estimator/neural/forward.hpp"
#include "tests/estimator/neural/sample.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown::experiments {
namespace {

struct Sizes {
  int hidden;
  int first;
  int second;
  Eigen::Index batch;
};

// Layers and batches that fill blocks and vectors, that leave a rest, and that are smaller than
// one.
TEST(BatchedNeuralForward, EqualsSingleSequences) {
  for (const Sizes& sizes : std::vector<Sizes>{{128, 256, 128, 13},
                                               {24, 16, 12, 7},
                                               {12, 24, 36, 16},
                                               {13, 25, 11, 1},
                                               {5, 3, 1, 8},
                                               {16, 8, 8, 24},
                                               {16, 8, 8, 25},
                                               {17, 31, 7, 40}}) {
    const auto network =
        test::shared(test::random_network(sizes.hidden, sizes.first, sizes.second));
    BatchedNeuralForward side_by_side(network, sizes.batch);
    std::vector<NeuralForward> one_by_one(static_cast<std::size_t>(sizes.batch),
                                          NeuralForward(network));
    test::Normal normal(3);
    for (int step = 0; step < 40; ++step) {
      if (step == 20) {
        side_by_side.reset();
        for (NeuralForward& one : one_by_one) one.reset();
      }
      BatchedNeuralForward::Columns inputs(neural_input_count, sizes.batch);
      for (float& x : inputs.reshaped()) x = static_cast<float>(normal());
      const auto& outputs = side_by_side.step(inputs);
      ASSERT_EQ(outputs.cols(), sizes.batch);
      for (Eigen::Index i = 0; i < sizes.batch; ++i) {
        const auto& expected = one_by_one[static_cast<std::size_t>(i)].step(inputs.col(i));
        ASSERT_LT((outputs.col(i) - expected).cwiseAbs().maxCoeff(), 1e-5F)
            << "sequence " << i << " of " << sizes.batch << ", hidden " << sizes.hidden;
      }
    }
  }
}

TEST(BatchedNeuralForward, RefusesNoNetworkAndAnEmptyBatch) {
  EXPECT_THROW(BatchedNeuralForward(nullptr, 3), InputError);
  EXPECT_THROW(BatchedNeuralForward(test::shared(test::random_network(8, 8, 8)), 0), InputError);
}

}  // namespace
}  // namespace touchdown::experiments
