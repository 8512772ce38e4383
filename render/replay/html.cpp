#include "render/replay/html.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "render/replay/data.hpp"
#include "render/report/html.hpp"

namespace touchdown::render {

namespace {

/// JSON inside a script element: nothing in it may close the element.
std::string inline_json(const nlohmann::ordered_json& data) {
  std::string text = data.dump();
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at)) {
    text.replace(at, 1, "\\u003c");
  }
  return text;
}

std::string engines_html(const std::vector<VideoSource>& runs) {
  if (runs.size() < 2) return {};
  std::string html = "<fieldset class=\"picks engines\"><legend>Engine</legend>\n";
  for (std::size_t i = 0; i < runs.size(); ++i) {
    html += fmt::format(
        "<label><input type=\"radio\" name=\"replay-engine\" value=\"{}\"{}> {}</label>\n", i,
        i == 0 ? " checked" : "", escaped(label_of(runs[i])));
  }
  return html + "</fieldset>\n";
}

/// The length of what is left out, in words.
std::string cap_text(const std::vector<VideoSource>& runs) {
  double end = 0.0;
  for (const VideoSource& run : runs) {
    end = std::max(end, run.recording.period() * static_cast<double>(run.recording.steps()));
  }
  return end > longest_replay + 1.0
             ? fmt::format(" Only the first {:.0f} of {:.0f} seconds are here.", longest_replay,
                           end)
             : "";
}

constexpr const char* controls = R"(<div class="stage">
<canvas class="view" tabindex="0" role="application" aria-label="The robot on its terrain. Arrow keys turn the view, plus and minus move it, Home resets it, Space plays."></canvas>
<p class="state" aria-hidden="true"></p>
</div>
<div class="transport">
<button type="button" class="play" aria-pressed="false">Play</button>
<label class="speed">Speed <select><option value="0.1">0.1×</option><option value="0.25">0.25×</option><option value="0.5">0.5×</option><option value="1" selected>1×</option><option value="2">2×</option></select></label>
<button type="button" class="reset">Reset view</button>
<button type="button" data-jump="flight" data-step="-1" aria-label="Previous flight">‹ Flight</button>
<button type="button" data-jump="flight" data-step="1" aria-label="Next flight">Flight ›</button>
<button type="button" data-jump="error" data-step="-1" aria-label="Previous error of the first estimator shown">‹ Error</button>
<button type="button" data-jump="error" data-step="1" aria-label="Next error of the first estimator shown">Error ›</button>
</div>
<canvas class="overview" aria-hidden="true"></canvas>
<input type="range" class="time" min="0" step="0.01" value="0" aria-label="Time">
<canvas class="curves" aria-hidden="true"></canvas>
<fieldset class="picks estimators-shown"><legend>P(contact): left wheel, right wheel</legend></fieldset>
)";

}  // namespace

std::string replay_html(const std::vector<VideoSource>& runs, const scoring::LabelConfig& labels) {
  return fmt::format(
      "<div class=\"replay\" hidden>\n{}{}"
      "<p class=\"note\">Drag to turn, scroll (after a click) or pinch to zoom. Wheels are green "
      "in true contact and orange in the air. Below, the whole run: true contact (green: dark of "
      "both wheels, light of one) with the errors of the first estimator shown in red. The curves "
      "show the seconds around the present, at {:.0f} Hz.{}</p>\n"
      "<script type=\"application/json\">{}</script>\n</div>\n"
      "<noscript><p class=\"note\">The replay needs JavaScript.</p></noscript>\n",
      engines_html(runs), controls, replay_belief_rate, cap_text(runs),
      inline_json(replay_data(runs, labels)));
}

}  // namespace touchdown::render
