#include "experiments/boosting/fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <xgboost/c_api.h>

#include <fmt/format.h>

#include "core/error.hpp"
#include "experiments/boosting/inputs.hpp"

namespace touchdown::experiments {

namespace {

void check(int failed) {
  if (failed != 0) throw Error(fmt::format("gradient boosting: {}", XGBGetLastError()));
}

struct MatrixDeleter {
  void operator()(void* handle) const { XGDMatrixFree(handle); }
};
struct BoosterDeleter {
  void operator()(void* handle) const { XGBoosterFree(handle); }
};
using Matrix = std::unique_ptr<void, MatrixDeleter>;
using Booster = std::unique_ptr<void, BoosterDeleter>;

/// Gives the rows to the library in batches, as its callbacks want them.
class RowBatches {
 public:
  /// Rows in contact have weight 1, the others `air_weight`.
  RowBatches(const BoostingRows& rows, float air_weight) : rows_(rows), weights_(rows.count()) {
    std::transform(rows.is_contact.begin(), rows.is_contact.end(), weights_.begin(),
                   [&](float is_contact) { return is_contact > 0.0F ? 1.0F : air_weight; });
    DMatrixHandle handle = nullptr;
    check(XGProxyDMatrixCreate(&handle));
    batch_.reset(handle);
  }

  [[nodiscard]] DMatrixHandle batch() const { return batch_.get(); }
  static void restart(DataIterHandle self) { static_cast<RowBatches*>(self)->next_ = 0; }
  static int go_on(DataIterHandle self) { return static_cast<RowBatches*>(self)->go_on(); }
  /// Whether the library refused a batch; for it the rows then end there.
  [[nodiscard]] bool failed() const { return failed_; }

 private:
  /// 0 after the last row.
  int go_on() {
    constexpr std::size_t most = 4096;
    const std::size_t count = std::min(most, rows_.count() - next_);
    if (count == 0) return 0;
    const std::string features =
        fmt::format(R"({{"data": [{}, true], "shape": [{}, {}], "typestr": "|u1", "version": 3}})",
                    reinterpret_cast<std::uintptr_t>(rows_.features.data() + next_ * rows_.width()),
                    count, rows_.width());
    failed_ =
        !(XGProxyDMatrixSetDataDense(batch(), features.c_str()) == 0 &&
          XGDMatrixSetFloatInfo(batch(), "label", rows_.is_contact.data() + next_, count) == 0 &&
          XGDMatrixSetFloatInfo(batch(), "weight", weights_.data() + next_, count) == 0);
    next_ += count;
    return failed_ ? 0 : 1;
  }

  const BoostingRows& rows_;
  std::vector<float> weights_;
  Matrix batch_;
  std::size_t next_ = 0;
  bool failed_ = false;
};

/// The library bins the rows' bins once more, one by one: as bytes, because a matrix of values
/// needs eight times the memory, and its quantiles of values twice that.
Matrix matrix_of(const BoostingRows& rows, float air_weight) {
  RowBatches batches(rows, air_weight);
  DMatrixHandle handle = nullptr;
  check(XGQuantileDMatrixCreateFromCallback(
      &batches, batches.batch(), nullptr, RowBatches::restart, RowBatches::go_on,
      R"({"missing": NaN, "nthread": 1, "max_bin": 256})", &handle));
  Matrix matrix(handle);
  check(batches.failed() ? -1 : 0);
  return matrix;
}

Booster booster_of(const Matrix& rows, const BoostingConfig& config) {
  DMatrixHandle matrix = rows.get();
  BoosterHandle handle = nullptr;
  check(XGBoosterCreate(&matrix, 1, &handle));
  Booster booster(handle);
  const auto set = [&](const char* name, const std::string& value) {
    check(XGBoosterSetParam(handle, name, value.c_str()));
  };
  set("objective", "binary:logistic");
  set("base_score", "0.5");  // the sum of leaves begins at zero
  set("tree_method", "hist");
  set("nthread", "1");
  set("verbosity", "0");
  set("seed", fmt::format("{}", config.seed));
  set("max_depth", fmt::format("{}", config.depth));
  set("eta", fmt::format("{}", config.learning_rate));
  set("min_child_weight", fmt::format("{}", config.least_weight));
  return booster;
}

/// Copies a node and its subtree into a complete tree. The source tree may have early leaves.
void put(const nlohmann::json& tree, const FeatureBins& bins, std::size_t from, std::size_t to,
         std::size_t number, BoostedTrees& trees) {
  const auto& left = tree.at("left_children");
  const auto& condition = tree.at("split_conditions");
  const std::size_t inner = trees.nodes();
  if (to >= inner) {
    trees.leaf[number * trees.leaves() + to - inner] = condition.at(from).get<float>();
    return;
  }
  const std::size_t node = number * inner + to;
  if (const int child = left.at(from).get<int>(); child >= 0) {
    trees.feature[node] = tree.at("split_indices").at(from).get<std::uint8_t>();
    const double bin = std::ceil(std::max(1.0, condition.at(from).get<double>()));
    trees.threshold[node] = bins.threshold(trees.feature[node], static_cast<std::size_t>(bin));
    put(tree, bins, static_cast<std::size_t>(child), 2 * to + 1, number, trees);
    put(tree, bins, tree.at("right_children").at(from).get<std::size_t>(), 2 * to + 2, number,
        trees);
  } else {  // an early leaf: all leaves below have its value
    put(tree, bins, from, 2 * to + 1, number, trees);
    put(tree, bins, from, 2 * to + 2, number, trees);
  }
}

BoostedTrees trees_of(const Booster& booster, const FeatureBins& bins, std::size_t depth) {
  bst_ulong length = 0;
  const char* text = nullptr;
  check(XGBoosterSaveModelToBuffer(booster.get(), R"({"format": "json"})", &length, &text));
  const nlohmann::json model = nlohmann::json::parse(std::string_view(text, length));
  const auto& all = model.at("learner").at("gradient_booster").at("model").at("trees");
  BoostedTrees trees{.depth = depth};
  trees.feature.resize(all.size() * trees.nodes());
  trees.threshold.resize(trees.feature.size());
  trees.leaf.resize(all.size() * trees.leaves());
  for (std::size_t number = 0; number < all.size(); ++number) {
    put(all[number], bins, 0, 0, number, trees);
  }
  return trees;
}

}  // namespace

FeatureBins::FeatureBins(std::span<const float> rows, std::size_t width)
    : cuts_(width), count_(width, 0) {
  const std::size_t rows_count = width == 0 ? 0 : rows.size() / width;
  std::vector<float> values(rows_count);
  for (std::size_t feature = 0; feature < width; ++feature) {
    for (std::size_t row = 0; row < rows_count; ++row) values[row] = rows[row * width + feature];
    std::sort(values.begin(), values.end());
    std::vector<float> different = values;
    different.erase(std::unique(different.begin(), different.end()), different.end());
    const bool is_exact = different.size() <= most;
    const std::vector<float>& from = is_exact ? different : values;
    const std::size_t bins = std::min(most, from.size());
    for (std::size_t b = 1; b < bins; ++b) {
      const float cut = from[b * from.size() / bins];
      const bool is_new =
          count_[feature] == 0 ? cut > from.front() : cut > cuts_[feature][count_[feature] - 1];
      if (is_new) cuts_[feature][count_[feature]++] = cut;
    }
  }
}

std::uint8_t FeatureBins::bin(std::size_t feature, float value) const noexcept {
  const auto first = cuts_[feature].begin();
  const auto last = first + static_cast<std::ptrdiff_t>(count_[feature]);
  return static_cast<std::uint8_t>(std::upper_bound(first, last, value) - first);
}

void FeatureBins::append(std::span<const float> row, std::vector<std::uint8_t>& bins) const {
  for (std::size_t feature = 0; feature < row.size(); ++feature) {
    bins.push_back(bin(feature, row[feature]));
  }
}

float FeatureBins::threshold(std::size_t feature, std::size_t bin) const noexcept {
  return bin <= count_[feature] ? cuts_[feature][bin - 1] : std::numeric_limits<float>::max();
}

BoostingRows binned(std::span<const float> features, std::vector<float> is_contact) {
  BoostingRows rows;
  const std::size_t width = is_contact.empty() ? 0 : features.size() / is_contact.size();
  rows.bins = FeatureBins(features, width);
  rows.features.reserve(features.size());
  for (std::size_t row = 0; row < is_contact.size(); ++row) {
    rows.bins.append(features.subspan(row * width, width), rows.features);
  }
  rows.is_contact = std::move(is_contact);
  return rows;
}

template <typename Inputs>
BoostingRows boosting_rows(std::span<const LabelledRun> runs, const BoostingConfig& config,
                           const std::function<void()>& before_run) {
  std::size_t steps = 0;
  for (const LabelledRun& run : runs) {
    check_labels(run);
    steps += run.signals.size() - std::min(run.signals.size(), run.skip);
  }
  // Each pass takes both wheels of every stride-th step.
  const std::size_t stride =
      std::max<std::size_t>(1, 2 * steps * config.passes / std::max<std::size_t>(1, config.rows));
  BoostingRows rows;
  std::vector<float> first;  // features before the bins are known
  const std::size_t expected = 2 * config.passes * (steps / stride + runs.size());
  rows.is_contact.reserve(expected);
  const auto bin_the_first = [&] {
    if (first.empty()) return;
    rows = binned(first, std::move(rows.is_contact));
    rows.features.reserve(expected * Inputs::count);
    first = {};
  };
  Draws draws(config.seed);
  for (std::size_t pass = 0; pass < config.passes; ++pass) {
    for (const LabelledRun& run : runs) {
      if (before_run) before_run();
      Inputs inputs(
          TreeInputsConfig{run.sample_rate, run.legs.value_or(config.legs), config.servo_load});
      Augmentation augmented(config.augmentation, draws, config.servo_load);
      std::size_t next = run.skip + draws.below(stride);
      for (std::size_t k = 0; k < run.signals.size(); ++k) {
        const TreeInputsStep step = inputs.update(augmented(run.signals[k]));
        if (k < next) continue;
        next += stride;
        for (std::size_t side = 0; side < 2; ++side) {
          if (!step.is_valid[side]) continue;
          const auto features = inputs.features(side);
          if (rows.width() == 0) {
            first.insert(first.end(), features.begin(), features.end());
          } else {
            rows.bins.append(features, rows.features);
          }
          rows.is_contact.push_back(run.contact[side][k] != 0 ? 1.0F : 0.0F);
        }
      }
    }
    constexpr std::size_t enough = 10'000;  // rows for quantiles
    if (rows.count() >= enough) bin_the_first();
  }
  bin_the_first();
  return rows;
}

template BoostingRows boosting_rows<SignalWindow>(std::span<const LabelledRun> runs,
                                                  const BoostingConfig& config,
                                                  const std::function<void()>& before_run);
template BoostingRows boosting_rows<ChannelInputs>(std::span<const LabelledRun> runs,
                                                   const BoostingConfig& config,
                                                   const std::function<void()>& before_run);

BoostedTrees fit_trees(BoostingRows rows, const BoostingConfig& config,
                       const std::function<void()>& before_tree) {
  const auto contact = static_cast<double>(std::ranges::count(rows.is_contact, 1.0F));
  const double air = static_cast<double>(rows.count()) - contact;
  if (!(contact > 0.0 && air > 0.0)) {
    throw InputError("gradient boosting: runs with contact and without are needed");
  }
  const auto air_weight = static_cast<float>(std::pow(air / contact, config.class_exponent));
  const Matrix matrix = matrix_of(rows, air_weight);
  rows.features = {};  // the matrix has copied what it needs
  const Booster booster = booster_of(matrix, config);
  for (std::size_t tree = 0; tree < config.trees; ++tree) {
    if (before_tree) before_tree();
    check(XGBoosterUpdateOneIter(booster.get(), static_cast<int>(tree), matrix.get()));
  }
  BoostedTrees trees = trees_of(booster, rows.bins, config.depth);
  trees.bias = std::log(air_weight);
  return trees;
}

}  // namespace touchdown::experiments
