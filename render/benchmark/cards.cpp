#include "render/benchmark/cards.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/files.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/results/captions.hpp"
#include "render/report/html.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {

namespace {

constexpr std::size_t most_failures = 4;  ///< scenes on a card
constexpr double failure = 0.95;          ///< a card lists scenes of lower balanced accuracy

std::string summary_of(const std::string& estimator) {
  for (const experiments::EstimatorEntry& entry : experiments::estimator_entries()) {
    if (entry.name == estimator) return entry.summary;
  }
  return "Submitted as beliefs";
}

/// The errors in a scene, of both kinds: missed flight and false flight.
std::string errors_of(const SceneScore& score) {
  const double missed = 1.0 - score.no_contact_recall;
  const double is_contact = 1.0 - score.no_contact_precision;
  if (std::isnan(missed)) {
    return fmt::format("the scene has no flight, and it reports {:.3g} false takeoffs per minute",
                       score.false_takeoffs_per_minute);
  }
  std::string text = fmt::format("misses {:.0f} % of the time in the air", 100.0 * missed);
  if (std::isnan(is_contact)) return text + " and never reports flight";
  return text + fmt::format("; {:.0f} % of the flight it reports is contact", 100.0 * is_contact);
}

std::string standing_text(const Standing& standing) {
  return fmt::format("{:.3f} ({}, {})", standing.mean.estimate, standing.setting, standing.noise);
}

std::string card(const BenchmarkScores& scores, const std::string& estimator,
                 const std::filesystem::path& run_directory) {
  const Standing* best = nullptr;
  const Standing* worst = nullptr;
  std::size_t not_worse = 0;
  std::size_t settings = 0;
  std::string excess;
  for (const Standing& standing : scores.standings) {
    if (standing.estimator != estimator) continue;
    ++settings;
    if (excess.empty() && !std::isnan(standing.excess_log_loss) &&
        !experiments::is_upper_bound(estimator)) {
      excess = fmt::format(
          " Its log loss exceeds that of the best reference upper bound by {:.3f} bits per wheel "
          "and "
          "step ({}, {}).",
          standing.excess_log_loss, standing.setting, standing.noise);
    }
    not_worse += standing.is_not_significantly_worse ? 1U : 0U;
    if (best == nullptr || standing.mean.estimate > best->mean.estimate) best = &standing;
    if (worst == nullptr || standing.mean.estimate < worst->mean.estimate) worst = &standing;
  }
  std::vector<const SceneScore*> failures;
  for (const SceneScore& score : scores.scenes) {
    if (score.estimator == estimator && score.accuracy.estimate < failure) {
      failures.push_back(&score);
    }
  }
  std::stable_sort(failures.begin(), failures.end(), [](const auto* one, const auto* other) {
    return one->accuracy.estimate < other->accuracy.estimate;
  });
  std::string items;
  std::vector<std::string> listed;
  for (const SceneScore* score : failures) {
    if (listed.size() == most_failures) break;
    if (std::find(listed.begin(), listed.end(), score->scene) != listed.end()) continue;
    listed.push_back(score->scene);
    items += fmt::format("<li><b>{}</b> {:.3f}: {} ({}, {}, {})</li>\n", escaped(score->scene),
                         score->accuracy.estimate, errors_of(*score),
                         escaped(simulators::simulator_title(score->simulator)),
                         escaped(score->setting), escaped(score->noise));
  }
  const std::filesystem::path film =
      run_directory / "videos" / fmt::format("worst_{}.mp4", estimator);
  const std::string film_html =
      is_there(film)
          ? fmt::format(
                "<figure class=\"film\"><video controls muted playsinline "
                "preload=\"metadata\" aria-label=\"The worst two seconds of {0}\" "
                "src=\"{1}\"></video>\n<figcaption>The two seconds in which it makes the most "
                "errors.</figcaption>"
                "</figure>\n",
                escaped(experiments::estimator_title(estimator)), data_uri("video/mp4", film))
          : "";
  return fmt::format(
      "<article class=\"card\">\n<h3>{}</h3>\n<p>{}. Not significantly worse than the best in {} "
      "of "
      "{} settings. Mean balanced accuracy: {} to {}.{}</p>\n{}{}</article>\n",
      escaped(experiments::estimator_title(estimator)), escaped(summary_of(estimator)), not_worse,
      settings, escaped(standing_text(*worst)), escaped(standing_text(*best)), escaped(excess),
      items.empty() ? fmt::format("<p>At least {:.2f} in every scene.</p>\n", failure)
                    : "<ul>\n" + items + "</ul>\n",
      film_html);
}

}  // namespace

std::string cards_html(const BenchmarkScores& scores, const std::filesystem::path& run_directory) {
  std::string html = "<div class=\"cards\">\n";
  for (const std::string& estimator :
       names(scores.standings, [](const Standing& standing) { return standing.estimator; })) {
    if (estimator == experiments::always_contact_name) continue;
    html += card(scores, estimator, run_directory);
  }
  return html + "</div>\n";
}

}  // namespace touchdown::render
