#include "estimator/evidence/curves.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "estimator/evidence/pairs.hpp"

namespace touchdown {

namespace {

bool all_finite(const auto& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](float x) { return std::isfinite(x); });
}

}  // namespace

float evidence_logit(const EvidenceModel& model, const DecisionInputs& inputs) noexcept {
  float sum = model.bias;
  for (std::size_t i = 0; i < decision_inputs; ++i) sum += evidence_at(model.curve[i], inputs[i]);
  for (std::size_t p = 0; p < model.table.size(); ++p) {
    const EvidencePlace row = evidence_place(inputs[evidence_pairs[p].first], evidence_pair_knots);
    const EvidencePlace column =
        evidence_place(inputs[evidence_pairs[p].second], evidence_pair_knots);
    constexpr auto width = static_cast<int>(evidence_pair_knots);
    const float* const knot = model.table[p].data() + row.knot * width + column.knot;
    const float near = knot[0] + column.share * (knot[1] - knot[0]);
    const float far = knot[width] + column.share * (knot[width + 1] - knot[width]);
    sum += near + row.share * (far - near);
  }
  return sum;
}

void check_evidence_model(const EvidenceModel& model) {
  if (!model.table.empty() && model.table.size() != evidence_pairs.size()) {
    throw InputError("evidence curves: expected a table for each pair, or none");
  }
  if (std::all_of(model.curve.begin(), model.curve.end(),
                  [](const auto& curve) { return all_finite(curve); }) &&
      std::all_of(model.table.begin(), model.table.end(),
                  [](const auto& table) { return all_finite(table); }) &&
      std::isfinite(model.bias)) {
    return;
  }
  throw InputError("evidence curves: their numbers must be finite");
}

}  // namespace touchdown
