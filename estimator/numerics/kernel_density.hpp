#pragma once

#include <memory>
#include <span>
#include <vector>

#include "estimator/numerics/axis.hpp"

namespace touchdown {

/// Scott's rule for one axis of a `dimensions`-dimensional density:
/// n^(−1/(d+4)) times the sample standard deviation (n − 1 in its denominator), but never less than
/// `floor`. Same unit as the samples.
/// Throws InputError when there are fewer than two samples, when one is not finite, or when the
/// result is zero (all samples equal and no floor).
double scott_bandwidth(std::span<const double> samples, int dimensions, double floor = 0.0);

/// Eq. (5) of the paper in one dimension: the mean of Gaussians of standard deviation `bandwidth`
/// around the samples, evaluated at every point of the axis. A density: it integrates to one over
/// the real line, unit 1/[x].
std::vector<double> kernel_density(std::span<const double> x, double bandwidth, const Axis& axis);

/// Eq. (5) of the paper in two dimensions with a product kernel (a diagonal bandwidth matrix), in
/// 1/([x]·[y]), at every point of a regular grid. The result has x_axis.count rows of y_axis.count
/// values, row after row.
///
/// exp(−(u² + v²)/2) = exp(−u²/2)·exp(−v²/2), so the whole grid is the product of two matrices of
/// one-dimensional kernels. No binning and no truncation: where both likelihoods are tiny, their
/// ratio still decides.
///
/// Throws InputError for no samples, x and y of different lengths, samples that are not finite, or
/// a bandwidth that is not positive and finite.
std::vector<double> kernel_density(std::span<const double> x, std::span<const double> y,
                                   double x_bandwidth, double y_bandwidth, const Axis& x_axis,
                                   const Axis& y_axis);

/// One direction of a density: the kernels' bandwidth and the axis.
struct KernelAxis {
  double bandwidth = 1.0;
  Axis axis;
};

/// `kernel_density` in two dimensions for each of `x_axes` with each of `y_axes`; all pairs with
/// the first of `x_axes` come first. They share the kernels, which take as long as the sums.
/// Errors: the same.
std::vector<std::vector<double>> kernel_densities(std::span<const double> x,
                                                  std::span<const double> y,
                                                  std::span<const KernelAxis> x_axes,
                                                  std::span<const KernelAxis> y_axes);

}  // namespace touchdown
