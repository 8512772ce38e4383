// Counts all calls of malloc and its siblings by this thread. operator new ends in one of them.
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <dlfcn.h>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "estimator/bayes/filter.hpp"
#include "estimator/bayes/measurement_only.hpp"
#include "estimator/force/load_filter.hpp"
#include "estimator/free_fall.hpp"
#include "estimator/odometry/filter.hpp"
#include "estimator/signal_assembler.hpp"
#include "estimator/upkie_observer.hpp"
#include "experiments/batch/bayes.hpp"
#include "tests/estimator/named_config.hpp"
#include "tests/estimator/synthetic.hpp"

namespace {
thread_local bool counting = false;
thread_local int calls = 0;
[[maybe_unused]] void count() noexcept { calls += counting ? 1 : 0; }
}  // namespace

// NOLINTBEGIN(readability-identifier-naming): the C library's names
extern "C" {
void* __libc_malloc(std::size_t);
void __libc_free(void*);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
void* malloc(std::size_t size) {
  count();
  return __libc_malloc(size);
}
void free(void* pointer) {
  count();
  __libc_free(pointer);
}
void* calloc(std::size_t n, std::size_t size) {
  count();
  return __libc_calloc(n, size);
}
void* realloc(void* pointer, std::size_t size) {
  count();
  return __libc_realloc(pointer, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  count();
  return __libc_memalign(alignment, size);
}
#endif
}
// NOLINTEND(readability-identifier-naming)

namespace touchdown {
namespace {

template <typename Function>
int allocations_of(const Function& function) {
  calls = 0;
  counting = true;
  function();
  counting = false;
  return calls;
}

class RealTime : public testing::Test {
 protected:
  void SetUp() override {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "the sanitizer has its own malloc";
#endif
  }
};

TEST_F(RealTime, CountsAllocations) {
  EXPECT_GE(allocations_of([] {
              std::vector<double> values(1000);
              const auto pointer = std::make_unique<double>(values.data()[7]);
              *const_cast<volatile double*>(pointer.get()) = 1.0;
            }),
            4);
}

TEST_F(RealTime, UpdateAndResetAllocateNothing) {
  auto stream = test::drops(3000);
  stream[100].vertical_acceleration = std::nan("");
  stream[200].leg[0].knee.torque = HUGE_VAL;
  stream[300].time = -5.0;
  stream[400].time = 1e9;
  for (const char* name : {"paper", "reference", "robust"}) {
    const BayesFilterConfig config = test::named(name);
    const auto samples = test::labelled(test::drops(3000), config.measurement.torque);
    const MeasurementModel model =
        fit_measurement_model(samples.contact, samples.no_contact, config.measurement.fit);
    BayesFilter filter(model, config);
    MeasurementOnly ablation(model, config);
    UpkieObserver observer;
    FreeFall free_fall;
    for (ContactEstimator* const estimator :
         {static_cast<ContactEstimator*>(&filter), static_cast<ContactEstimator*>(&ablation),
          static_cast<ContactEstimator*>(&observer), static_cast<ContactEstimator*>(&free_fall)}) {
      EXPECT_EQ(allocations_of([&] {
                  for (const Signals& s : stream) {
                    estimator->update(s);
                  }
                  estimator->reset();
                }),
                0)
          << name;
    }
  }
}

TEST_F(RealTime, TheLoadFilterAllocatesNothing) {
  auto stream = test::drops(3000);
  for (Signals& s : stream) {
    for (const double sign : {1.0, -1.0}) {  // bent legs, which have observable forces
      LegSignals& leg = s.leg[sign > 0.0 ? 0 : 1];
      leg.hip.position = 0.455 * sign;
      leg.knee.position = -0.791 * sign;
    }
  }
  stream[100].vertical_acceleration = std::nan("");
  stream[200].leg[0].knee.torque = HUGE_VAL;
  stream[300].leg[1].knee.velocity = std::nan("");
  stream[400].time = 1e9;
  for (std::size_t k = 500; k < 1500; ++k) {  // targets come and go
    for (std::size_t side = 0; side < 2; ++side) {
      const LegSignals& leg = stream[k].leg[side];
      stream[k].target[side].hip = {leg.hip.position, 0.0, 0.1, 40.0, 2.0};
      stream[k].target[side].knee = {leg.knee.position, 0.0, 0.1, 40.0, 2.0};
    }
  }
  LoadFilter filter;
  filter.update(stream.front());
  EXPECT_NE(filter.update(stream[1]).wheel[0].p_contact, 0.5);
  EXPECT_EQ(allocations_of([&] {
              for (const Signals& s : stream) {
                filter.update(s);
              }
              filter.reset();
            }),
            0);
}

TEST_F(RealTime, BatchesAllocateNothing) {
  const auto stream = test::drops(1000);
  for (const char* name : {"paper", "reference", "robust"}) {
    const BayesFilterConfig config = test::named(name);
    const auto samples = test::labelled(test::drops(3000), config.measurement.torque);
    const std::vector<experiments::BatchNoise> levels{
        {0.0, 0.0, 0.0}, {1.0, 1.0, 5.0}, {3.0, 3.0, 10.0}};
    experiments::BatchedBayesFilter batch(
        fit_measurement_model(samples.contact, samples.no_contact, config.measurement.fit), config,
        levels);
    EXPECT_EQ(allocations_of([&] {
                for (const Signals& s : stream) {
                  batch.update(s, experiments::NoiseStep{});
                }
              }),
              0)
        << name;
  }
}

TEST_F(RealTime, TheAssemblerAllocatesNothing) {
  SignalAssembler assembler;
  std::array<JointSignals, 6> joints{};
  RobotRecord record;
  record.joints = joints;
  EXPECT_EQ(allocations_of([&] {
              for (int k = 0; k < 2000; ++k) {
                record.time = k == 700 ? 0.0 : 1e-3 * k;
                record.orientation = {0.0, 0.0, k > 1000 ? 1.0 : 0.0, k > 1000 ? 0.0 : 1.0};
                record.proper_acceleration = {0.0, 0.0, -9.81};
                record.linear_acceleration.setZero();
                assembler.assemble(record);
              }
              assembler.reset();
            }),
            0);
}

static_assert(noexcept(std::declval<SignalAssembler&>().assemble(std::declval<RobotRecord>())));

TEST_F(RealTime, OdometryAllocatesNothing) {
  odometry::ContactOdometry filter;
  odometry::OdometrySample sample;
  sample.specific_force.z() = -9.81;
  EXPECT_EQ(allocations_of([&] {
              for (int k = 0; k < 2000; ++k) {
                sample.time = 1e-3 * k;
                sample.leg[0].velocity[2] = k % 100 == 7 ? std::nan("") : 3.0;
                sample.p_contact = {0.9, 0.001 * (k % 1000)};
                filter.update(sample);
              }
              filter.reset();
            }),
            0);
  EXPECT_NE(filter.state().covariance(0, 0), 0.0);
}

static_assert(noexcept(std::declval<odometry::ContactOdometry&>().update(
    std::declval<const odometry::OdometrySample&>())));
static_assert(noexcept(std::declval<ContactEstimator&>().update(std::declval<Signals>())));
static_assert(noexcept(std::declval<ContactEstimator&>().reset()));

}  // namespace
}  // namespace touchdown
