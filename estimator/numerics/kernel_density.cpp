#include "estimator/numerics/kernel_density.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <Eigen/Core>

#include "core/error.hpp"
#include "estimator/numerics/flush_denormals.hpp"

namespace touchdown {
namespace {

using Matrix = Eigen::MatrixXd;

/// Samples that are added at once: both kernel matrices stay in the second-level cache.
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

double scott_bandwidth(std::span<const double> samples, int dimensions, double floor) {
  check_samples(samples, 2);
  const auto n = static_cast<double>(samples.size());
  // A copy, because Eigen's sums over foreign memory depend on where in memory it lies.
  const Eigen::ArrayXd x =
      Eigen::Map<const Eigen::ArrayXd>(samples.data(), static_cast<Eigen::Index>(samples.size()));
  return scott_bandwidth(n, std::sqrt((x - x.mean()).square().sum() / (n - 1.0)), dimensions,
                         floor);
}

double scott_bandwidth(double count, double deviation, int dimensions, double floor) {
  const double bandwidth = std::max(floor, std::pow(count, -1.0 / (dimensions + 4)) * deviation);
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
  if (x.size() != y.size()) {
    throw InputError("a kernel density needs as many x as y samples, got " +
                     std::to_string(x.size()) + " and " + std::to_string(y.size()));
  }
  check_samples(x, 1);
  check_samples(y, 1);
  KernelDensityGrid grid(x_bandwidth, y_bandwidth, x_axis, y_axis);
  for (std::size_t i = 0; i < x.size(); ++i) grid.add(x[i], y[i]);
  return grid.density();
}

struct KernelDensityGrid::Sums {
  Sums(double x_width, double y_width, const Axis& x_axis, const Axis& y_axis)
      : x_bandwidth(x_width),
        y_bandwidth(y_width),
        x_points(points_of(x_axis)),
        y_points(points_of(y_axis)),
        x_kernels(x_axis.count, block),
        y_kernels(y_axis.count, block),
        sum(Matrix::Zero(y_axis.count, x_axis.count)) {
    x.reserve(block);
    y.reserve(block);
  }

  void add_block() {
    const FlushDenormals flush;
    const auto columns = static_cast<Eigen::Index>(x.size());
    fill_kernels(x, x_bandwidth, x_points, x_kernels);
    fill_kernels(y, y_bandwidth, y_points, y_kernels);
    sum.noalias() += y_kernels.leftCols(columns) * x_kernels.leftCols(columns).transpose();
    count += x.size();
    x.clear();
    y.clear();
  }

  double x_bandwidth;
  double y_bandwidth;
  Eigen::ArrayXd x_points;
  Eigen::ArrayXd y_points;
  std::vector<double> x;  // samples that are not in the sum yet
  std::vector<double> y;
  Matrix x_kernels;
  Matrix y_kernels;
  // Column-major with y along the rows is row-major with y along the columns.
  Matrix sum;
  std::size_t count = 0;
};

KernelDensityGrid::KernelDensityGrid(double x_bandwidth, double y_bandwidth, const Axis& x_axis,
                                     const Axis& y_axis) {
  check_bandwidth(x_bandwidth);
  check_bandwidth(y_bandwidth);
  check_axis(x_axis, "first");
  check_axis(y_axis, "second");
  sums_ = std::make_unique<Sums>(x_bandwidth, y_bandwidth, x_axis, y_axis);
}

KernelDensityGrid::~KernelDensityGrid() = default;
KernelDensityGrid::KernelDensityGrid(KernelDensityGrid&&) noexcept = default;
KernelDensityGrid& KernelDensityGrid::operator=(KernelDensityGrid&&) noexcept = default;

void KernelDensityGrid::add(double x, double y) {
  if (!std::isfinite(x) || !std::isfinite(y)) {
    throw InputError("a kernel density needs finite samples, got (" + std::to_string(x) + ", " +
                     std::to_string(y) + ")");
  }
  sums_->x.push_back(x);
  sums_->y.push_back(y);
  if (sums_->x.size() == block) sums_->add_block();
}

std::vector<double> KernelDensityGrid::density() {
  if (!sums_->x.empty()) sums_->add_block();
  if (sums_->count == 0) throw InputError("a kernel density needs at least 1 sample, got 0");
  const Matrix density = sums_->sum / (static_cast<double>(sums_->count) * 2.0 * std::numbers::pi *
                                       sums_->x_bandwidth * sums_->y_bandwidth);
  return {density.data(), density.data() + density.size()};
}

}  // namespace touchdown
