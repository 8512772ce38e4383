#pragma once

#include "estimator/bayes/measurement_model.hpp"
#include "estimator/bayes/transition_model.hpp"

namespace touchdown {

/// bel(S_t) for both values of S_t. The filter keeps both, because near certainty 1 − bel(C) would
/// be mere rounding error, and the next prediction starts from it.
struct ContactState {
  double contact = 0.5;
  double no_contact = 0.5;
};

/// Eq. (2a): bel-bar(S_t) = Σ_S P(S_t | S_t−1 = S) bel(S_t−1). The published matrix's rows do not
/// sum to one, so neither does this pair.
inline ContactState predict(const Transition& p, const ContactState& bel) noexcept {
  return {p.contact_to_contact * bel.contact + p.air_to_contact * bel.no_contact,
          p.contact_to_air * bel.contact + p.air_to_air * bel.no_contact};
}

/// Eq. (2b) and (3). If every product is zero, the old belief stays.
inline ContactState correct(const Likelihoods& p, const ContactState& predicted,
                            const ContactState& bel) noexcept {
  const ContactState joint{p.contact * predicted.contact, p.no_contact * predicted.no_contact};
  const double eta = joint.contact + joint.no_contact;
  return eta > 0.0 ? ContactState{joint.contact / eta, joint.no_contact / eta} : bel;
}

}  // namespace touchdown
