#include "render/benchmark/cards.hpp"

#include <cmath>

#include <fmt/format.h>

#include "experiments/estimators/registry.hpp"
#include "experiments/results/captions.hpp"
#include "render/report/html.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {

namespace {

constexpr std::size_t failures_told = 4;
constexpr double failure = 0.95;  ///< accuracy under which a scene is told of

std::string summary_of(const std::string& estimator) {
  for (const experiments::EstimatorEntry& entry : experiments::estimator_entries()) {
    if (entry.name == estimator) return entry.summary;
  }
  return "handed in as beliefs";
}

/// What goes wrong in a scene, from the two ways in which one can be wrong.
std::string what_is_wrong(const SceneScore& score) {
  const double missed = 1.0 - score.no_contact_recall;
  const double invented = 1.0 - score.no_contact_precision;
  if (std::isnan(missed)) {
    return fmt::format("there is no flight, and it tells of {:.3g} a minute",
                       score.false_takeoffs_per_minute);
  }
  std::string text = fmt::format("misses {:.0f} % of the time in the air", 100.0 * missed);
  if (std::isnan(invented)) return text + " and says nothing else";
  return text + fmt::format("; {:.0f} % of what it calls flight is contact", 100.0 * invented);
}

std::string place_text(const Standing& place) {
  return fmt::format("{:.3f} ({}, {})", place.mean.estimate, place.setting, place.noise);
}

std::string card(const BenchmarkScores& scores, const std::string& estimator,
                 const std::filesystem::path& run_directory) {
  const Standing* best = nullptr;
  const Standing* worst = nullptr;
  std::size_t level = 0;
  std::size_t settings = 0;
  std::string left;
  for (const Standing& place : scores.standings) {
    if (place.estimator != estimator) continue;
    ++settings;
    if (left.empty() && !std::isnan(place.bits_left) && !experiments::is_upper_bound(estimator)) {
      left = fmt::format(" It leaves {:.3f} bits a step to the learned ceiling ({}, {}).",
                         place.bits_left, place.setting, place.noise);
    }
    level += place.is_not_significantly_worse ? 1U : 0U;
    if (best == nullptr || place.mean.estimate > best->mean.estimate) best = &place;
    if (worst == nullptr || place.mean.estimate < worst->mean.estimate) worst = &place;
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
  std::vector<std::string> told;
  for (const SceneScore* score : failures) {
    if (told.size() == failures_told) break;
    if (std::find(told.begin(), told.end(), score->scene) != told.end()) continue;
    told.push_back(score->scene);
    items += fmt::format("<li><b>{}</b> {:.3f}: {} ({}, {}, {})</li>\n", escaped(score->scene),
                         score->accuracy.estimate, what_is_wrong(*score),
                         escaped(simulators::simulator_title(score->simulator)),
                         escaped(score->setting), escaped(score->noise));
  }
  const std::filesystem::path film =
      run_directory / "videos" / fmt::format("worst_{}.mp4", estimator);
  const std::string film_html =
      std::filesystem::exists(film)
          ? fmt::format(
                "<figure class=\"film\"><video controls muted playsinline "
                "preload=\"metadata\" aria-label=\"The worst two seconds of {0}\" "
                "src=\"{1}\"></video>\n<figcaption>Its worst two seconds.</figcaption>"
                "</figure>\n",
                escaped(experiments::estimator_title(estimator)), data_uri("video/mp4", film))
          : "";
  return fmt::format(
      "<article class=\"card\">\n<h3>{}</h3>\n<p>{}. Level with the first in {} of {} settings; "
      "from {} to {}.{}</p>\n{}{}</article>\n",
      escaped(experiments::estimator_title(estimator)), escaped(summary_of(estimator)), level,
      settings, escaped(place_text(*worst)), escaped(place_text(*best)), escaped(left),
      items.empty() ? fmt::format("<p>Never under {:.2f}.</p>\n", failure)
                    : "<ul>\n" + items + "</ul>\n",
      film_html);
}

}  // namespace

std::string cards_html(const BenchmarkScores& scores, const std::filesystem::path& run_directory) {
  std::string html = "<div class=\"cards\">\n";
  for (const std::string& estimator :
       names(scores.standings, [](const Standing& place) { return place.estimator; })) {
    if (estimator == experiments::always_contact_name) continue;
    html += card(scores, estimator, run_directory);
  }
  return html + "</div>\n";
}

}  // namespace touchdown::render
