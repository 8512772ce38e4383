#include "render/curves/latency_data.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "render/gnuplot/text.hpp"

namespace touchdown::render {
namespace {

/// A histogram's outline from its first to its last event: each bin as high as its share of the
/// fullest one, standing on `base`.
std::string outline(const scoring::LatencyHistogram& histogram, double base) {
  const auto& events = histogram.events;
  const std::int32_t most = *std::max_element(events.begin(), events.end());
  if (most == 0) return "NaN\tNaN\tNaN\n";
  constexpr double highest = 0.82, half = 0.5e-3 * scoring::LatencyHistogram::width_us;
  std::string text;
  for (std::size_t b = 0; b < events.size(); ++b) {
    const double x = scoring::LatencyHistogram::centre_ms(b);
    const double y = base + highest * events[b] / most;
    for (const double edge : {x - half, x + half}) {
      fmt::format_to(std::back_inserter(text), "{}\t{}\t{}\n", edge, base, y);
    }
  }
  return text;
}

/// With a minus sign that is as wide as the plus sign, and without one where zero is meant.
std::string signed_text(double value) {
  std::string text = fmt::format("{:.1f}", std::abs(value));
  return value < 0.0 && text != "0.0" ? "−" + text : text;
}

}  // namespace

std::string latency_data(const LatencyFigure& figure) {
  std::string text = "#latency_ms\tbase\theight\n";
  std::string means;
  for (const LatencyPanel& panel : figure.panels) {
    for (const LatencyKind& kind : latency_kinds) {
      for (std::size_t r = 0; r < panel.rows.size(); ++r) {
        const scoring::TransitionCounts& counts = panel.rows[r].*kind.counts;
        const auto base = static_cast<double>(panel.rows.size() - 1 - r);
        text += outline(counts.latency, base) + "\n\n";
        const double mean = 1e3 * counts.latency_mean();
        const double deviation = 1e3 * counts.latency_deviation();
        std::string says = counts.detected > 0 ? signed_text(mean) : "–";
        if (std::isfinite(deviation)) says += fmt::format(" ± {:.1f} ms", deviation);
        means += fmt::format("{}\t{}\t\"{}\\n{} of {} found\"\n", number(mean), base, says,
                             counts.detected, counts.events);
      }
      means += "\n\n";
    }
  }
  return text + "#mean_ms\tbase\ttext\n" + means;
}

}  // namespace touchdown::render
