#ifndef TOUCHDOWN_TOUCHDOWN_H
#define TOUCHDOWN_TOUCHDOWN_H

/* Contact estimation in plain C: an estimator from a model file that `touchdown fit` wrote, one
 * record per control step, one belief per record. No exception leaves these functions. An estimator
 * must not be used by two threads at once; different ones may be. */

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct touchdown_estimator touchdown_estimator;

/* What a program expects of the model; NULL and 0 are taken as the model has them. */
typedef struct touchdown_use {
  const char* estimator; /* "robust", "phase", … */
  double sample_rate;    /* at which touchdown_update will be called (Hz) */
  const char* robot;
} touchdown_use;

typedef struct touchdown_joint {
  double position; /* rad */
  double velocity; /* rad/s */
  double torque;   /* N·m */
} touchdown_joint;

/* One control step, in Upkie's signs and frames. What was not reported is NaN. */
typedef struct touchdown_record {
  double time;                    /* s; only differences count */
  touchdown_joint joint[6];       /* left hip, knee, wheel, right hip, knee, wheel */
  double orientation[4];          /* w x y z, from the IMU to x forward, y right, z down */
  double angular_velocity[3];     /* of the IMU in its frame (rad/s) */
  double linear_acceleration[3];  /* of the IMU in its frame, without gravity (m/s²) */
  double proper_acceleration[3];  /* as its chip measures it (m/s²): tells up from down */
  double ground_velocity_command; /* that the policy gave at the step before (m/s) */
} touchdown_record;

enum touchdown_status {
  TOUCHDOWN_GOOD = 0,
  TOUCHDOWN_INVALID = 1, /* signals that cannot be used: the belief relaxes */
  TOUCHDOWN_GAP = 2,     /* time jumped */
  TOUCHDOWN_FROZEN = 3   /* a sensor repeats itself */
};

/* What may be wrong with a record, as bits. */
enum touchdown_fault {
  TOUCHDOWN_JOINT_MISSING = 1,
  TOUCHDOWN_JOINT_STALE = 2,
  TOUCHDOWN_ORIENTATION_MISSING = 4,
  TOUCHDOWN_UPSIDE_DOWN = 8,
  TOUCHDOWN_ACCELERATION_MISSING = 16,
  TOUCHDOWN_CLOCK_MISSING = 32,
  TOUCHDOWN_CLOCK_BACK = 64,
  TOUCHDOWN_CLOCK_GAP = 128,
  TOUCHDOWN_CLOCK_RATE = 256
};

/* Left wheel, right wheel. */
typedef struct touchdown_belief {
  double p_contact[2];
  int contact[2]; /* 1: in contact */
  double p_any_wheel;
  double p_both_wheels;
  int status;      /* enum touchdown_status */
  unsigned faults; /* of enum touchdown_fault */
} touchdown_belief;

/* A record in which nothing is reported, to be filled in. */
touchdown_record touchdown_empty_record(void);

/* Reads the model; of the component `models`, all else is of `estimator`. Returns NULL if that is
 * not possible, and then writes a line that says why to `error`, of `error_size` bytes with the
 * terminating zero; both may be NULL and 0, and so may `use`. To be given to touchdown_destroy in
 * the end. */
touchdown_estimator* touchdown_create(const char* model_path, const touchdown_use* use, char* error,
                                      size_t error_size);

/* Takes one step. Neither fails nor allocates nor locks. */
touchdown_belief touchdown_update(touchdown_estimator* estimator, const touchdown_record* record);

/* Forgets all that was heard. */
void touchdown_reset(touchdown_estimator* estimator);

/* May be given NULL. */
void touchdown_destroy(touchdown_estimator* estimator);

/* "robust, 1000 Hz, robot upkie, fingerprint …": which model it is; valid until it is destroyed. */
const char* touchdown_model_text(const touchdown_estimator* estimator);

/* "good", "invalid", "gap", "frozen". */
const char* touchdown_status_text(int status);

#ifdef __cplusplus
}
#endif

#endif
