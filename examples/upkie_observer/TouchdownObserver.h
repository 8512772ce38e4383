#pragma once

#include <touchdown/touchdown.h>

#include <memory>
#include <string>

#include "upkie/cpp/observers/Observer.h"

namespace upkie::cpp::observers {

/*! Believes which wheels touch the ground, by a fitted model of touchdown's.
 *
 * To be appended after FloorContact: it writes its decision to `floor_contact.contact`, where
 * controllers look for it, and to `contact` of each wheel; beside them P(contact) of each wheel,
 * `p_any_wheel`, `p_both_wheels`, the status of the signals and what was wrong with them. What else
 * FloorContact wrote stays.
 */
class TouchdownObserver : public Observer {
 public:
  struct Parameters {
    /*! Configure from the dictionary given to reset, if it has a section `touchdown`:
     *
     * model: file of a fitted model. robot: name it has to be fitted to. decides: whether
     * `floor_contact.contact` is to be ours (the default) or stays FloorContact's.
     */
    void configure(const Dictionary& config);

    //! Time between two calls of read, in [s].
    double dt = 0.001;

    //! What `touchdown fit` wrote.
    std::string model;

    //! Robot that it has to be fitted to; any if empty.
    std::string robot = "upkie";

    //! Write our decision to `floor_contact.contact`.
    bool decides = true;
  };

  //! Releases what touchdown_create returned.
  struct Destroy {
    void operator()(touchdown_estimator* estimator) const noexcept {
      touchdown_destroy(estimator);
    }
  };
  using Estimator = std::unique_ptr<touchdown_estimator, Destroy>;

  /*! Read the model.
   *
   * \throw std::runtime_error If it cannot be used: unreadable, fitted to another robot or at
   *     another frequency. Without a model, reset has to name one.
   */
  explicit TouchdownObserver(const Parameters& params);

  //! With an estimator that comes from elsewhere, such as a model that is compiled in.
  TouchdownObserver(const Parameters& params, Estimator estimator);

  inline std::string prefix() const noexcept final { return "floor_contact"; }

  //! Forget what was heard; read another model if the configuration names one. Throws likewise.
  void reset(const Dictionary& config) override;

  //! Take one step. What is not in the observation yet counts as not reported.
  void read(const Dictionary& observation) override;

  //! Write the belief.
  void write(Dictionary& observation) override;

  //! "robust, 1000 Hz, robot upkie, fingerprint ...".
  std::string model() const;

 private:
  void load();

  Parameters params_;
  Estimator estimator_;
  std::string loaded_;
  touchdown_belief belief_{};
  double time_ = 0.0;
};

}  // namespace upkie::cpp::observers
