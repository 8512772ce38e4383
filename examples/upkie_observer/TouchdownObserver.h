#pragma once

#include <touchdown/touchdown.h>

#include <memory>
#include <string>

#include "upkie/cpp/observers/Observer.h"

namespace upkie::cpp::observers {

/*! Estimates contact of the wheels with touchdown.
 *
 * Append it after FloorContact. It writes its decision to `floor_contact.contact`, which controllers
 * read, and to `contact` of each wheel. It adds P(contact) of each wheel, `p_any_wheel`,
 * `p_both_wheels`, the status of the signals and their faults. Other keys of FloorContact stay.
 */
class TouchdownObserver : public Observer {
 public:
  struct Parameters {
    /*! Configure from the dictionary given to reset, if it has a section `touchdown`:
     *
     * model: file of the robot's legs and masses, or of a fitted model. robot: name of the robot that
     * the file must be of. decides: whether this observer (the default) or FloorContact writes
     * `floor_contact.contact`.
     */
    void configure(const Dictionary& config);

    //! Time between two calls of read, in [s].
    double dt = 0.001;

    //! File written by `touchdown convert ROBOT`, or model file written by `touchdown fit`.
    std::string model;

    //! Robot that the file must be of; any if empty.
    std::string robot = "upkie";

    //! Write the decision to `floor_contact.contact`.
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
   * \throw std::runtime_error If it cannot be used: unreadable, of another robot or for
   *     another frequency. Without a file, the configuration of reset must name one.
   */
  explicit TouchdownObserver(const Parameters& params);

  //! Use a given estimator, such as one with a compiled-in model.
  TouchdownObserver(const Parameters& params, Estimator estimator);

  inline std::string prefix() const noexcept final { return "floor_contact"; }

  //! Reset the belief; read another file if the configuration names one. Throws as the constructor.
  void reset(const Dictionary& config) override;

  //! Process one observation. Missing keys count as not reported.
  void read(const Dictionary& observation) override;

  //! Write the belief.
  void write(Dictionary& observation) override;

  //! "load_filter, 1000 Hz, robot upkie, fingerprint ...".
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
