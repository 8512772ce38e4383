#include "estimator/numerics/kernel_density.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <Eigen/Core>

#include "core/error.hpp"
#include "estimator/numerics/flush_denormals.hpp"

namespace touchdown {
namespace {

using Matrix = Eigen::MatrixXd;

/// Number of samples per block, such that both kernel matrices stay in the second-level cache.
constexpr std::size_t block = 256;

void check_samples(std::span<const double> samples, std::size_t at_least) {
  if (samples.size() < at_least) {
    throw InputError("a kernel density needs at least " + std::to_string(at_least) +
                     (at_least == 1 ? " sample" : " samples") + ", got " +
                     std::to_string(samples.size()));
  }
  const auto bad = std::find_if_not(samples.begin(), samples.end(),
                                    [](double value) { return std::isfinite(value); });
  if (bad != samples.end()) {
    throw InputError("a kernel density needs finite samples; sample " +
                     std::to_string(bad - samples.begin()) + " is " + std::to_string(*bad));
  }
}

void check_bandwidth(double bandwidth) {
  if (!std::isfinite(bandwidth) || !(bandwidth > 0.0)) {
    throw InputError("a kernel's bandwidth must be positive and finite, got " +
                     std::to_string(bandwidth));
  }
}

/// One column per sample: the kernel, without its constant factor, at every point of the axis.
void fill_kernels(std::span<const double> samples, double bandwidth, const Eigen::ArrayXd& points,
                  Matrix& kernels) {
  const double scale = std::numbers::sqrt2 / 2.0 / bandwidth;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    kernels.col(static_cast<Eigen::Index>(i)).array() =
        (-((points - samples[i]) * scale).square()).exp();
  }
}

Eigen::ArrayXd points_of(const Axis& axis) {
  Eigen::ArrayXd points(axis.count);
  for (int i = 0; i < axis.count; ++i) points[i] = axis[i];
  return points;
}

}  // namespace

/// The kernels of a block of samples along one axis.
class AxisKernels {
 public:
  AxisKernels(const KernelAxis& axis, const char* name) : bandwidth_(axis.bandwidth) {
    check_bandwidth(axis.bandwidth);
    check_axis(axis.axis, name);
    points_ = points_of(axis.axis);
    kernels_.resize(points_.size(), block);
  }

  void fill(std::span<const double> samples) {
    fill_kernels(samples, bandwidth_, points_, kernels_);
    columns_ = static_cast<Eigen::Index>(samples.size());
  }

  [[nodiscard]] auto filled() const { return kernels_.leftCols(columns_); }
  [[nodiscard]] Eigen::Index points() const { return points_.size(); }
  [[nodiscard]] double bandwidth() const { return bandwidth_; }

 private:
  double bandwidth_;
  Eigen::ArrayXd points_;
  Matrix kernels_;
  Eigen::Index columns_ = 0;
};

/// The sums of products of kernels, for each axis along x with each along y.
class KernelSums {
 public:
  KernelSums(std::span<const KernelAxis> x_axes, std::span<const KernelAxis> y_axes) {
    for (const KernelAxis& axis : x_axes) x_.emplace_back(axis, "first");
    for (const KernelAxis& axis : y_axes) y_.emplace_back(axis, "second");
    for (const AxisKernels& along_x : x_) {
      // Column-major with y along the rows is row-major with y along the columns.
      for (const AxisKernels& along_y : y_) {
        sums_.emplace_back(Matrix::Zero(along_y.points(), along_x.points()));
      }
    }
  }

  /// At most `block` samples.
  void add(std::span<const double> x, std::span<const double> y) {
    const FlushDenormals flush;
    for (AxisKernels& axis : x_) axis.fill(x);
    for (AxisKernels& axis : y_) axis.fill(y);
    auto sum = sums_.begin();
    for (const AxisKernels& along_x : x_) {
      for (const AxisKernels& along_y : y_) {
        sum++->noalias() += along_y.filled() * along_x.filled().transpose();
      }
    }
    count_ += x.size();
  }

  /// Of all pairs of axes, those with the first axis along x first. Each frees its sums: together
  /// they would take twice the memory.
  [[nodiscard]] std::vector<std::vector<double>> take_densities() && {
    std::vector<std::vector<double>> all;
    for (std::size_t pair = 0; pair < sums_.size(); ++pair) {
      const AxisKernels& along_x = x_[pair / y_.size()];
      const AxisKernels& along_y = y_[pair % y_.size()];
      const Matrix density = sums_[pair] / (static_cast<double>(count_) * 2.0 * std::numbers::pi *
                                            along_x.bandwidth() * along_y.bandwidth());
      all.emplace_back(density.data(), density.data() + density.size());
      sums_[pair] = Matrix();
    }
    return all;
  }

 private:
  std::vector<AxisKernels> x_;
  std::vector<AxisKernels> y_;
  std::vector<Matrix> sums_;
  std::size_t count_ = 0;
};

double scott_bandwidth(std::span<const double> samples, int dimensions, double floor) {
  check_samples(samples, 2);
  const auto n = static_cast<double>(samples.size());
  // A copy, because Eigen's sums over mapped memory depend on its alignment.
  const Eigen::ArrayXd x =
      Eigen::Map<const Eigen::ArrayXd>(samples.data(), static_cast<Eigen::Index>(samples.size()));
  const double deviation = std::sqrt((x - x.mean()).square().sum() / (n - 1.0));
  const double bandwidth = std::max(floor, std::pow(n, -1.0 / (dimensions + 4)) * deviation);
  if (!(bandwidth > 0.0)) {
    throw InputError("all samples are equal: Scott's rule gives no bandwidth, set a floor");
  }
  return bandwidth;
}

std::vector<double> kernel_density(std::span<const double> x, double bandwidth, const Axis& axis) {
  check_samples(x, 1);
  check_bandwidth(bandwidth);
  check_axis(axis, "density");
  const FlushDenormals flush;
  const Eigen::ArrayXd points = points_of(axis);
  const double scale = std::numbers::sqrt2 / 2.0 / bandwidth;
  Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(axis.count);
  for (const double sample : x) sum += (-((points - sample) * scale).square()).exp();
  sum /= static_cast<double>(x.size()) * bandwidth * std::sqrt(2.0 * std::numbers::pi);
  return {sum.begin(), sum.end()};
}

std::vector<double> kernel_density(std::span<const double> x, std::span<const double> y,
                                   double x_bandwidth, double y_bandwidth, const Axis& x_axis,
                                   const Axis& y_axis) {
  const KernelAxis along_x{x_bandwidth, x_axis};
  const KernelAxis along_y{y_bandwidth, y_axis};
  return std::move(kernel_densities(x, y, {&along_x, 1}, {&along_y, 1}).front());
}

std::vector<std::vector<double>> kernel_densities(std::span<const double> x,
                                                  std::span<const double> y,
                                                  std::span<const KernelAxis> x_axes,
                                                  std::span<const KernelAxis> y_axes) {
  if (x.size() != y.size()) {
    throw InputError("a kernel density needs as many x as y samples, got " +
                     std::to_string(x.size()) + " and " + std::to_string(y.size()));
  }
  check_samples(x, 1);
  check_samples(y, 1);
  KernelSums sums(x_axes, y_axes);
  for (std::size_t first = 0; first < x.size(); first += block) {
    const std::size_t count = std::min(block, x.size() - first);
    sums.add(x.subspan(first, count), y.subspan(first, count));
  }
  return std::move(sums).take_densities();
}

}  // namespace touchdown
