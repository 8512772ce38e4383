#pragma once

/// All that a robot needs: its measurements (`Signals`), the belief about its contacts (`Belief`),
/// the estimators, and the fits of those that have a model.

#include "core/error.hpp"
#include "estimator/bayes/config.hpp"
#include "estimator/bayes/filter.hpp"
#include "estimator/bayes/measurement_fit.hpp"
#include "estimator/bayes/measurement_only.hpp"
#include "estimator/contact_estimator.hpp"
#include "estimator/force/load_filter.hpp"
#include "estimator/free_fall.hpp"
#include "estimator/models/make_estimator.hpp"
#include "estimator/models/metadata.hpp"
#include "estimator/neural/estimator.hpp"
#include "estimator/record.hpp"
#include "estimator/signal_assembler.hpp"
#include "estimator/signals.hpp"
#include "estimator/upkie_observer.hpp"
