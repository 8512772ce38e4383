#pragma once

/// All that a robot needs: what it measures (`Signals`), what is believed of it (`Belief`), the
/// estimators, and how those that learn are fitted.

#include "estimator/assembly/record.hpp"
#include "estimator/assembly/signal_assembler.hpp"
#include "estimator/bayes/config.hpp"
#include "estimator/bayes/filter.hpp"
#include "estimator/bayes/measurement_fit.hpp"
#include "estimator/bayes/measurement_only.hpp"
#include "estimator/contact_estimator.hpp"
#include "estimator/decision/filter.hpp"
#include "estimator/decision/fit.hpp"
#include "estimator/force/force_kinematics.hpp"
#include "estimator/force/force_kinematics_fit.hpp"
#include "estimator/force/load_logistic.hpp"
#include "estimator/force/load_logistic_fit.hpp"
#include "estimator/force/support_force.hpp"
#include "estimator/free_fall.hpp"
#include "estimator/models/compiled.hpp"
#include "estimator/models/make_estimator.hpp"
#include "estimator/models/passport.hpp"
#include "estimator/neural/estimator.hpp"
#include "estimator/phase/filter.hpp"
#include "estimator/phase/fit.hpp"
#include "estimator/signals.hpp"
#include "estimator/upkie_observer.hpp"
